// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "framework/core/error.h"
#include "framework/importers/mesh_file_checks.h"

namespace kaustik::scene {
namespace {

// A mesh of this size has some 50 million triangles; more is a damaged file or a bomb.
constexpr std::size_t kLargestContents = std::size_t{2} << 30;
// Meshes shrink to a third or, as text with many zeros, to a twentieth; a bomb to a thousandth.
constexpr std::size_t kLargestRatio = 200;
constexpr std::size_t kAlwaysAllowed = std::size_t{64} << 20;

std::size_t largestContents(std::size_t zippedBytes) {
    return std::clamp(zippedBytes * kLargestRatio, kAlwaysAllowed, kLargestContents);
}

class Inflater {
  public:
    explicit Inflater(const std::string& name) : name_(name) {
        // 16: gzip only, with its checksum and length verified by zlib.
        if (::inflateInit2(&stream_, 16 + MAX_WBITS) != Z_OK) fail("out of memory");
    }
    ~Inflater() { ::inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    // Hands the contents on in pieces.
    template <class Take>
    void run(std::string_view bytes, const Take& take) {
        if (::inflateReset(&stream_) != Z_OK) fail("out of memory");
        std::vector<char> block(std::size_t{1} << 18);
        std::size_t consumed = 0;
        bool ended = false;
        // A gzip file is one or more members, one after the other.
        while (!ended || consumed < bytes.size()) {
            if (ended && ::inflateReset(&stream_) != Z_OK) fail("out of memory");
            ended = false;
            const std::size_t available =
                std::min<std::size_t>(bytes.size() - consumed, std::numeric_limits<uInt>::max());
            stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + consumed));
            stream_.avail_in = static_cast<uInt>(available);
            stream_.next_out = reinterpret_cast<Bytef*>(block.data());
            stream_.avail_out = static_cast<uInt>(block.size());
            const int status = ::inflate(&stream_, Z_NO_FLUSH);
            const std::size_t produced = block.size() - stream_.avail_out;
            consumed += available - stream_.avail_in;
            take(std::string_view(block.data(), produced));
            ended = status == Z_STREAM_END;
            // No progress: all is read and the end has not come.
            if (status == Z_BUF_ERROR) fail("it is cut off");
            if (status != Z_OK && !ended) {
                fail(stream_.msg != nullptr ? stream_.msg : "it is damaged");
            }
        }
    }

    [[noreturn]] void fail(const std::string& reason) {
        throw IoError(fmt::format("{} is not a whole gzip file: {}. Fetch or export it again.",
                                  name_, reason));
    }

  private:
    const std::string& name_;
    z_stream stream_{};
};

}  // namespace

std::string gunzip(std::string_view bytes, const std::string& name) {
    Inflater inflater(name);
    // How long it is comes before any memory for it.
    const std::size_t most = largestContents(bytes.size());
    std::size_t length = 0;
    inflater.run(bytes, [&](std::string_view piece) {
        length += piece.size();
        if (length <= most) return;
        throw IoError(fmt::format(
            "{}: its {} bytes hold more than {} MiB, which no mesh of that size does. Fetch or "
            "export it again.",
            name, bytes.size(), most >> 20));
    });
    std::string contents;
    contents.reserve(length);
    inflater.run(bytes, [&](std::string_view piece) { contents += piece; });
    return contents;
}

}  // namespace kaustik::scene
