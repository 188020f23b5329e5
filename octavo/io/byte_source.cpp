// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <octavo/io/byte_source.hpp>

namespace octavo::io {
namespace {

Error failure(const std::string& path, const char* what) {
    Error error{ErrorCode::io, std::string(what) + ": " + std::strerror(errno), {}};
    error.place.file = path;
    return error;
}

/// What all sources have in common: a name, a size, and the refusal of what is not there.
class NamedSource : public ByteSource {
  public:
    explicit NamedSource(std::string name) : name_(std::move(name)) {}
    std::uint64_t size() const override { return size_; }
    const std::string& name() const override { return name_; }

  protected:
    bool holds(std::uint64_t offset, std::size_t size) const {
        return offset <= size_ && size <= size_ - offset;
    }
    Error ends_early() const {
        Error error{ErrorCode::bad_input, "the file ends early", {}};
        error.place.file = name_;
        error.place.byte = size_;
        return error;
    }

    std::string name_;
    std::uint64_t size_ = 0;
};

class FileSource final : public NamedSource {
  public:
    using NamedSource::NamedSource;

    Status open() {
        errno = 0;
        file_.open(name_, std::ios::binary | std::ios::ate);
        if (!file_) return failure(name_, "cannot be opened");
        const std::streamoff end = file_.tellg();
        if (end < 0) return failure(name_, "cannot be read in parts");
        size_ = static_cast<std::uint64_t>(end);
        return Done{};
    }

    Result<ByteRange> read(std::uint64_t offset, std::size_t size) override {
        if (!holds(offset, size)) return ends_early();
        ByteBlock block(size);
        errno = 0;
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(offset));
        file_.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(size));
        if (file_.gcount() == static_cast<std::streamsize>(size)) return ByteRange(std::move(block));
        return file_.bad() ? failure(name_, "cannot be read") : ends_early();
    }

  private:
    std::ifstream file_;
};

class MappedFile final : public NamedSource {
  public:
    using NamedSource::NamedSource;
    ~MappedFile() override {
        if (begin_) munmap(begin_, size_);
    }

    Status open() {
        const int file = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) return failure(name_, "cannot be opened");
        const Status mapped = map(file);
        ::close(file);
        return mapped;
    }

    Result<ByteRange> read(std::uint64_t offset, std::size_t size) override {
        if (!holds(offset, size)) return ends_early();
        return ByteRange::view({static_cast<const std::byte*>(begin_) + offset, size});
    }

  private:
    Status map(int file) {
        struct stat about {};
        if (fstat(file, &about) != 0) return failure(name_, "cannot be read");
        if (!S_ISREG(about.st_mode)) {
            errno = ENODEV;
            return failure(name_, "cannot be mapped");
        }
        const auto size = static_cast<std::size_t>(about.st_size);
        if (size == 0) return Done{};  // Nothing to map, and nothing is ever read.
        void* begin = mmap(nullptr, size, PROT_READ, MAP_SHARED, file, 0);
        if (begin == MAP_FAILED) return failure(name_, "cannot be mapped");
        begin_ = begin;
        size_ = size;
        return Done{};
    }

    void* begin_ = nullptr;
};

class MemorySource final : public NamedSource {
  public:
    MemorySource(ByteBlock block, std::string name) : NamedSource(std::move(name)), block_(std::move(block)) {
        size_ = block_.size();
    }
    Result<ByteRange> read(std::uint64_t offset, std::size_t size) override {
        if (!holds(offset, size)) return ends_early();
        return ByteRange::view(block_.bytes().subspan(offset, size));
    }

  private:
    ByteBlock block_;
};

template <class Source>
Result<std::unique_ptr<ByteSource>> opened(const std::string& path) {
    auto source = std::make_unique<Source>(path);
    if (Status done = source->open(); !done) return done.error();
    return std::unique_ptr<ByteSource>(std::move(source));
}

}  // namespace

Result<std::unique_ptr<ByteSource>> open_file(const std::string& path) { return opened<FileSource>(path); }

Result<std::unique_ptr<ByteSource>> map_file(const std::string& path) { return opened<MappedFile>(path); }

std::unique_ptr<ByteSource> source_of(ByteBlock block, std::string name) {
    return std::make_unique<MemorySource>(std::move(block), std::move(name));
}

}  // namespace octavo::io
