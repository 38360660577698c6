// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "framework/core/error.h"
#include "framework/importers/mesh_formats.h"

namespace kaustik::scene {
namespace {

class Inflater {
  public:
    explicit Inflater(const std::string& name) : name_(name) {
        // 16: gzip only, with its checksum and length verified by zlib.
        if (::inflateInit2(&stream_, 16 + MAX_WBITS) != Z_OK) fail("out of memory");
    }
    ~Inflater() { ::inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    std::string run(std::string_view bytes) {
        std::string contents;
        std::vector<char> block(std::size_t{1} << 18);
        std::size_t consumed = 0;
        bool ended = false;
        // A gzip file is one or more members, one after the other.
        while (!ended || consumed < bytes.size()) {
            if (ended && ::inflateReset(&stream_) != Z_OK) fail("out of memory");
            const std::size_t available =
                std::min<std::size_t>(bytes.size() - consumed, std::numeric_limits<uInt>::max());
            stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + consumed));
            stream_.avail_in = static_cast<uInt>(available);
            stream_.next_out = reinterpret_cast<Bytef*>(block.data());
            stream_.avail_out = static_cast<uInt>(block.size());
            const int status = ::inflate(&stream_, Z_NO_FLUSH);
            consumed += available - stream_.avail_in;
            contents.append(block.data(), block.size() - stream_.avail_out);
            ended = status == Z_STREAM_END;
            // No progress: all is read and the end has not come.
            if (status == Z_BUF_ERROR) fail("it is cut off");
            if (status != Z_OK && !ended) {
                fail(stream_.msg != nullptr ? stream_.msg : "it is damaged");
            }
        }
        return contents;
    }

  private:
    [[noreturn]] void fail(const std::string& reason) {
        throw IoError(fmt::format("{} is not a whole gzip file: {}. Fetch or export it again.",
                                  name_, reason));
    }

    const std::string& name_;
    z_stream stream_{};
};

}  // namespace

std::string gunzip(std::string_view bytes, const std::string& name) {
    return Inflater(name).run(bytes);
}

}  // namespace kaustik::scene
