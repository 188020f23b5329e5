// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <octavo/io/output.hpp>

namespace octavo::io {
namespace {

namespace fs = std::filesystem;

/// What a symbolic link leads to, also where nothing is there yet, so that renaming replaces the file and not the link.
Result<fs::path> resolved(fs::path path) {
    constexpr int most_links = 40;  // as many as Linux follows
    std::error_code trouble;
    for (int links = 0; fs::is_symlink(fs::symlink_status(path, trouble)); ++links) {
        if (links == most_links)
            return Error{ErrorCode::io, "cannot be written: links lead round in a circle", {}};
        const fs::path target = fs::read_symlink(path, trouble);
        if (trouble) break;
        path = path.parent_path() / target;
    }
    return path;
}

/// The name with `ending`, shortened where file systems would not take it: 255 bytes are what they have in common.
fs::path with_ending(const fs::path& path, const std::string& ending) {
    constexpr std::size_t longest = 255;
    std::string name = path.filename().string();
    std::size_t kept = std::min(name.size(), longest - ending.size());
    // Not within a character of UTF-8.
    while (kept < name.size() && kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xc0) == 0x80) --kept;
    name.resize(kept);
    return path.parent_path() / (name + ending);
}

/// Creates a new file beside `path` and returns its descriptor and name. The name is tried, not drawn, so
/// that the system applies the user's mask of permissions to it.
std::pair<int, std::string> create_beside(const fs::path& path) {
    for (int attempt = 0;; ++attempt) {
        const std::string ending = "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
        std::string name = with_ending(path, ending).string();
        const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST || attempt == 1000) return {descriptor, std::move(name)};
    }
}

Error file_error(const std::string& path, const std::string& sentence) {
    Place place;
    place.file = path;
    return {ErrorCode::io, sentence, std::move(place)};
}

}  // namespace

Result<Output> Output::to_file(const std::string& path, const Context& context) {
    Output output;
    output.path_ = path;
    output.cancel_ = context.cancel;
    if (path == "-") {
        output.descriptor_ = ::dup(STDOUT_FILENO);
        if (output.descriptor_ < 0)
            return file_error(path, std::string("cannot be written: ") + std::strerror(errno));
        return output;
    }
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return file_error(path, "is a folder, not a file");
    if (exists && !S_ISREG(status.st_mode)) {
        // Of a pipe this waits for a reader; a signal that asks to stop interrupts it.
        do {
            output.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
        } while (output.descriptor_ < 0 && errno == EINTR && !context.cancelled());
        if (output.descriptor_ < 0 && context.cancelled()) return Context::cancelled_error();
    } else {
        const Result<fs::path> target = resolved(path);
        if (!target) return file_error(path, target.error().sentence);
        output.final_path_ = target->string();
        auto [descriptor, name] = create_beside(*target);
        output.descriptor_ = descriptor;
        if (descriptor >= 0) output.temporary_path_ = std::move(name);
        // Replacing keeps the permissions; where the system refuses that, the new file's own are good too.
        if (exists && descriptor >= 0) static_cast<void>(::fchmod(descriptor, status.st_mode & 07777));
    }
    if (output.descriptor_ < 0)
        return file_error(path, std::string("cannot be written: ") + std::strerror(errno));
    return output;
}

Output::Output(Output&& other) noexcept
    : buffer_(std::move(other.buffer_)),
      filled_(std::exchange(other.filled_, 0)),
      flushed_(other.flushed_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      final_path_(std::move(other.final_path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      trouble_(std::move(other.trouble_)),
      cancel_(other.cancel_) {}

Output::~Output() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

void Output::remember(const char* what) {
    if (trouble_.empty()) trouble_ = std::string(what) + ": " + std::strerror(errno);
}

void Output::append(std::string_view text) {
    while (!text.empty()) {
        char* const to = room(1);
        const std::size_t part = std::min(text.size(), buffer_.size() - filled_);
        std::memcpy(to, text.data(), part);
        filled_ += part;
        text.remove_prefix(part);
    }
}

void Output::flush() {
    if (descriptor_ < 0) {
        buffer_.resize(2 * buffer_.size());
        return;
    }
    const char* p = buffer_.data();
    while (filled_ > 0 && trouble_.empty() && !is_cancelled()) {
        const ssize_t written = ::write(descriptor_, p, filled_);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            remember("cannot be written");
            break;
        }
        p += written;
        flushed_ += static_cast<std::uint64_t>(written);
        filled_ -= static_cast<std::size_t>(written);
    }
    filled_ = 0;
}

Status Output::commit() {
    if (descriptor_ < 0) return Done{};
    flush();
    if (is_cancelled()) return Context::cancelled_error();
    if (::close(std::exchange(descriptor_, -1)) != 0) remember("cannot be written");
    if (trouble_.empty() && !temporary_path_.empty()) {
        if (::rename(temporary_path_.c_str(), final_path_.c_str()) == 0) {
            temporary_path_.clear();
        } else {
            remember("cannot be renamed into place");
        }
    }
    if (!trouble_.empty()) return file_error(path_, trouble_);
    return Done{};
}

std::vector<std::byte> Output::take_memory() && {
    const Bytes bytes = bytes_of({buffer_.data(), filled_});
    return {bytes.begin(), bytes.end()};
}

}  // namespace octavo::io
