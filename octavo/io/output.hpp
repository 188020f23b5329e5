// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/number.hpp>

// Where writers put their bytes: a file, standard output, or memory. A file is written under a temporary name
// in its own folder and renamed on commit, so that nobody ever sees half of it and a failure leaves the old
// one alone. Pipes and devices are written directly. Trouble on the way is remembered and told by commit. A write that
// waits, for whoever reads a pipe, ends when a signal interrupts it and the Context is cancelled.

namespace octavo::io {

class Output {
  public:
    /// Opens the file `path` for writing, or standard output when it is "-". Errors: io, cancelled.
    static Result<Output> to_file(const std::string& path, const Context& context = {});
    static Output to_memory() { return {}; }

    Output(Output&& other) noexcept;
    Output& operator=(Output&&) = delete;
    /// Without a commit before, the temporary file is removed.
    ~Output();

    void append(std::string_view text);
    void append(Bytes bytes) { append(text_of(bytes)); }
    void append(char c) { *room(1) = c, ++filled_; }
    void append_number(double value) { end_at(write_number(room(longest_number), value)); }
    void append_number(std::uint64_t value) { end_at(write_number(room(longest_number), value)); }
    template <class T, std::endian order = std::endian::little>
    void append_binary(T value) {
        store<T, order>(reinterpret_cast<std::byte*>(room(sizeof value)), value);
        filled_ += sizeof value;
    }
    std::uint64_t size() const { return flushed_ + filled_; }

    /// Writes what is left and gives the file its name. Only once. Errors: io, cancelled.
    Status commit();
    /// What was written to memory.
    std::vector<std::byte> take_memory() &&;

  private:
    Output() : buffer_(step) {}
    char* room(std::size_t size) {
        if (buffer_.size() - filled_ < size) flush();
        return buffer_.data() + filled_;
    }
    void end_at(const char* end) { filled_ = static_cast<std::size_t>(end - buffer_.data()); }
    void flush();
    void remember(const char* what);
    bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

    // Larger writes gain nothing; smaller ones cost system calls.
    static constexpr std::size_t step = std::size_t{1} << 16;

    std::vector<char> buffer_;
    std::size_t filled_ = 0;
    std::uint64_t flushed_ = 0;
    int descriptor_ = -1;         ///< -1: to memory
    std::string path_;            ///< as the caller named it, for messages
    std::string final_path_;      ///< what the temporary file becomes
    std::string temporary_path_;  ///< empty when written directly
    std::string trouble_;         ///< the first failure
    const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace octavo::io
