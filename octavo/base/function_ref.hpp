// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace octavo {

template <class Signature>
class FunctionRef;

/// A callable that somebody else owns, for parameters: two words, never allocates, one indirect call.
template <class Return, class... Arguments>
class FunctionRef<Return(Arguments...)> {
  public:
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
        FunctionRef(const Callable& callable)
        : callable_(std::addressof(callable)),
          call_([](const void* object, Arguments... arguments) -> Return {
              return (*static_cast<const Callable*>(object))(std::forward<Arguments>(arguments)...);
          }) {}

    Return operator()(Arguments... arguments) const {
        return call_(callable_, std::forward<Arguments>(arguments)...);
    }

  private:
    const void* callable_;
    Return (*call_)(const void*, Arguments...);
};

}  // namespace octavo
