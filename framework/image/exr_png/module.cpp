// SPDX-License-Identifier: MIT
// The module kaustik_exr_png.so: OpenEXR and PNG alone, by their own libraries, behind the C
// boundary of module_interface.h. It needs no more than these, so that it can go along to a machine
// that has no OpenImageIO. Values come and go as stored, as OpenImageIO's module has them.
#include <IexBaseExc.h>
#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "framework/image/exr_png/exr_header.h"
#include "framework/image/image_limits.h"
#include "framework/image/module_guard.h"

namespace {

using kaustik::guarded;

void requireSize(std::int64_t width, std::int64_t height, std::int64_t channels) {
    const std::string problem = kaustik::imageSizeProblem(width, height, channels);
    if (!problem.empty()) throw std::runtime_error("it " + problem);
}

float* allocate(const KaustikImageSink* sink, std::int64_t width, std::int64_t height,
                std::int64_t channels) {
    requireSize(width, height, channels);
    float* const values = sink->allocate(sink->context, static_cast<int>(width),
                                         static_cast<int>(height), static_cast<int>(channels));
    if (values == nullptr) throw std::bad_alloc();
    return values;
}

// Bytes in memory as OpenEXR reads them.
class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::string_view bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char target[], int count) override {
        if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - position_)
            throw std::runtime_error("it is damaged or cut off (its pixels end early)");
        std::memcpy(target, bytes_.data() + position_, static_cast<std::size_t>(count));
        position_ += static_cast<std::size_t>(count);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override {
        position_ = std::min(static_cast<std::size_t>(position), bytes_.size());
    }

  private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : OStream("memory") {}
    void write(const char source[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (bytes_.size() < position_ + size) bytes_.resize(position_ + size);
        std::memcpy(bytes_.data() + position_, source, size);
        position_ += size;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    [[nodiscard]] const std::vector<char>& bytes() const { return bytes_; }

  private:
    std::vector<char> bytes_;
    std::size_t position_ = 0;
};

// By how OpenImageIO calls them.
const char* channelName(int channels, int channel) {
    static constexpr std::array kColors{"R", "G", "B", "A"};
    return channels == 1 ? "Y" : kColors.at(static_cast<std::size_t>(channel));
}

// Those of the file in the order of an image's: red, green, blue and alpha first.
std::vector<std::string> channelsOf(const Imf::ChannelList& list) {
    std::vector<std::string> names;
    for (const char* color : {"R", "G", "B", "Y", "A"}) {
        if (list.findChannel(color) != nullptr) names.emplace_back(color);
    }
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        const std::string name = channel.name();
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw std::runtime_error("its channel '" + name + "' has fewer pixels than others");
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

// OpenEXR's sentence without the name that it has for the file, and without its period.
std::string reasonOf(const Iex::BaseExc& error) {
    const std::string_view name = "\"memory\". ";
    std::string reason = error.what();
    if (const std::size_t at = reason.find(name); at != std::string::npos)
        reason.erase(0, at + name.size());
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n'))
        reason.pop_back();
    return reason;
}

// Reads the channels of a file into room that `allocateFor(width, height, names)` gives.
template <class AllocateFor>
void readExrPixels(std::string_view bytes, AllocateFor allocateFor) {
    // Asked before anything is allocated by what the header says.
    kaustik::requireWholeAttributes(bytes);
    Imf::Header::setMaxImageSize(kaustik::kLargestImageSide, kaustik::kLargestImageSide);
    Imf::Header::setMaxTileSize(kaustik::kLargestImageSide, kaustik::kLargestImageSide);
    MemoryInput stream(bytes);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    const std::vector<std::string> names = channelsOf(file.header().channels());
    float* const values = allocateFor(width, height, names, file.header());
    const std::size_t pixelBytes = sizeof(float) * names.size();
    const std::size_t rowBytes = pixelBytes * static_cast<std::size_t>(width);
    Imf::FrameBuffer target;
    for (std::size_t i = 0; i < names.size(); ++i) {
        target.insert(names[i], Imf::Slice::Make(Imf::FLOAT, values + i, window.min, width, height,
                                                 pixelBytes, rowBytes));
    }
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
}

template <class AllocateFor>
void readExr(std::string_view bytes, AllocateFor allocateFor) {
    try {
        readExrPixels(bytes, allocateFor);
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(fmt::format("it is damaged or cut off ({})", reasonOf(error)));
    }
}

void readExr(std::string_view bytes, const KaustikImageSink* sink) {
    readExr(bytes, [&](std::int64_t width, std::int64_t height,
                       const std::vector<std::string>& names, const Imf::Header&) {
        return allocate(sink, width, height, static_cast<std::int64_t>(names.size()));
    });
}

// What libpng is handed, and what it says.
struct PngCall {
    std::string_view input;
    std::size_t position = 0;
    std::string output;
    std::string problem;
};

[[noreturn]] void failPng(png_structp png, png_const_charp message) {
    static_cast<PngCall*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
}
void ignorePngWarning(png_structp, png_const_charp) {}

void readPngBytes(png_structp png, png_bytep target, std::size_t count) {
    auto& call = *static_cast<PngCall*>(png_get_io_ptr(png));
    if (count > call.input.size() - call.position) png_error(png, "its pixels end early");
    std::memcpy(target, call.input.data() + call.position, count);
    call.position += count;
}

struct PngHeader {
    png_uint_32 width = 0;
    png_uint_32 height = 0;
    int channels = 0;
    bool has16Bits = false;
};

// libpng leaves by longjmp: nothing with a destructor may begin between here and what it returns
// to.
bool readPngHeader(png_structp png, png_infop info, PngHeader& header) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    header.width = png_get_image_width(png, info);
    header.height = png_get_image_height(png, info);
    header.channels = png_get_channels(png, info);
    return true;
}
// As samples of eight or sixteen bits.
bool expandPng(png_structp png, png_infop info, PngHeader& header) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_expand(png);
    if (png_get_bit_depth(png, info) == 16) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    header.channels = png_get_channels(png, info);
    header.has16Bits = png_get_bit_depth(png, info) == 16;
    return true;
}
bool readPngRows(png_structp png, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

class PngReader {
  public:
    explicit PngReader(std::string_view bytes) {
        call_.input = bytes;
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &call_, failPng, ignorePngWarning);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours are asked below
        png_set_read_fn(png_, &call_, readPngBytes);
    }
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    void read(const KaustikImageSink* sink) {
        PngHeader header;
        check(readPngHeader(png_, info_, header));
        requireSize(header.width, header.height, header.channels);
        check(expandPng(png_, info_, header));
        float* const values = allocate(sink, header.width, header.height, header.channels);
        const std::size_t samples =
            static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.channels);
        const std::size_t rowBytes = samples * (header.has16Bits ? 2 : 1);
        std::vector<unsigned char> pixels(rowBytes * header.height);
        std::vector<png_bytep> rows(header.height);
        for (std::size_t row = 0; row < rows.size(); ++row)
            rows[row] = pixels.data() + row * rowBytes;
        check(readPngRows(png_, rows.data()));
        for (std::size_t i = 0; i < samples * header.height; ++i) {
            std::uint16_t word = 0;
            if (header.has16Bits) std::memcpy(&word, pixels.data() + 2 * i, sizeof(word));
            values[i] = header.has16Bits ? static_cast<float>(word) / 65535.0f
                                         : static_cast<float>(pixels[i]) / 255.0f;
        }
    }

  private:
    void check(bool isRight) const {
        if (isRight) return;
        throw std::runtime_error(fmt::format("it is damaged or cut off ({})", call_.problem));
    }
    PngCall call_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

void writePngBytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& call = *static_cast<PngCall*>(png_get_io_ptr(png));
    bool isKept = true;
    try {
        call.output.append(reinterpret_cast<const char*>(bytes), count);
    } catch (const std::exception&) {
        isKept = false;
    }
    if (!isKept) png_error(png, "out of memory");
}
void flushPng(png_structp) {}

bool writePng(png_structp png, png_infop info, int width, int height, int color, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 color, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    png_write_image(png, rows);
    png_write_end(png, nullptr);
    return true;
}

void read(std::string_view bytes, const KaustikImageSink* sink) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return readExr(bytes, sink);
    if (bytes.starts_with("\x89PNG"sv)) return PngReader(bytes).read(sink);
    throw std::runtime_error(
        "it is damaged or no image (its first bytes are neither those of an OpenEXR nor of a PNG "
        "file, which are all that is read without OpenImageIO)");
}

bool readFile(const char* path, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        if (!file) throw std::runtime_error("it cannot be opened");
        read(bytes, sink);
    });
}

bool readMemory(const unsigned char* bytes, std::size_t count, const KaustikImageSink* sink) {
    return guarded(
        sink, [&] { read(std::string_view(reinterpret_cast<const char*>(bytes), count), sink); });
}

bool readLayers(const char* path, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        if (!file) throw std::runtime_error("it cannot be opened");
        readExr(bytes, [&](std::int64_t width, std::int64_t height,
                           const std::vector<std::string>& names, const Imf::Header& header) {
            const auto channels = static_cast<std::int64_t>(names.size());
            const std::string problem = kaustik::layeredSizeProblem(width, height, channels);
            if (!problem.empty()) throw std::runtime_error("it " + problem);
            float* const values =
                sink->allocate(sink->context, static_cast<int>(width), static_cast<int>(height),
                               static_cast<int>(channels));
            if (values == nullptr) throw std::bad_alloc();
            for (const std::string& name : names) {
                if (!sink->channel(sink->context, name.c_str())) throw std::bad_alloc();
            }
            for (auto i = header.begin(); i != header.end(); ++i) {
                const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
                if (text != nullptr &&
                    !sink->attribute(sink->context, i.name(), text->value().c_str()))
                    throw std::bad_alloc();
            }
            return values;
        });
    });
}

// Channel i has the name that `nameOf(i)` gives.
template <class NameOf>
void encode(const float* values, int width, int height, int channels, Imf::Header& header,
            NameOf nameOf, const KaustikImageSink* sink) {
    header.compression() = Imf::ZIP_COMPRESSION;
    const std::size_t pixelBytes = sizeof(float) * static_cast<std::size_t>(channels);
    const std::size_t rowBytes = pixelBytes * static_cast<std::size_t>(width);
    Imf::FrameBuffer source;
    for (int i = 0; i < channels; ++i) {
        header.channels().insert(nameOf(i), Imf::Channel(Imf::FLOAT));
        source.insert(nameOf(i), Imf::Slice::Make(Imf::FLOAT, values + i, {0, 0}, width, height,
                                                  pixelBytes, rowBytes));
    }
    MemoryOutput stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(source);
        file.writePixels(height);
    }
    const std::vector<char>& bytes = stream.bytes();
    if (!sink->append(sink->context, reinterpret_cast<const unsigned char*>(bytes.data()),
                      bytes.size())) {
        throw std::bad_alloc();
    }
}

bool encodeExr(const float* values, int width, int height, int channels,
               const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        Imf::Header header(width, height);
        encode(
            values, width, height, channels, header,
            [&](int channel) { return channelName(channels, channel); }, sink);
    });
}

bool encodeLayers(const float* values, int width, int height, int channels,
                  const KaustikImageLayers* layers, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        Imf::Header header(width, height);
        for (std::size_t i = 0; i < layers->attributeCount; ++i) {
            header.insert(layers->attributeNames[i],
                          Imf::StringAttribute(layers->attributeValues[i]));
        }
        encode(
            values, width, height, channels, header,
            [&](int channel) { return layers->channels[channel]; }, sink);
    });
}

bool encodePng(const unsigned char* values, int width, int height, int channels,
               const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        static constexpr std::array kColors{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                            PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
        std::vector<png_bytep> rows(static_cast<std::size_t>(height));
        const std::size_t rowBytes =
            static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
        for (std::size_t row = 0; row < rows.size(); ++row)
            rows[row] = const_cast<png_bytep>(values + row * rowBytes);
        PngCall call;
        png_structp png =
            png_create_write_struct(PNG_LIBPNG_VER_STRING, &call, failPng, ignorePngWarning);
        png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
        if (info == nullptr) {
            png_destroy_write_struct(&png, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png, &call, writePngBytes, flushPng);
        const bool isWritten =
            writePng(png, info, width, height, kColors.at(static_cast<std::size_t>(channels - 1)),
                     rows.data());
        png_destroy_write_struct(&png, &info);
        if (!isWritten) throw std::runtime_error(call.problem);
        if (!sink->append(sink->context, reinterpret_cast<const unsigned char*>(call.output.data()),
                          call.output.size())) {
            throw std::bad_alloc();
        }
    });
}

constexpr KaustikImageFunctions kFunctions{kKaustikImageModuleVersion,
                                           "EXR and PNG, by OpenEXR and libpng",
                                           readFile,
                                           readMemory,
                                           encodeExr,
                                           encodePng,
                                           readLayers,
                                           encodeLayers};

}  // namespace

extern "C" __attribute__((visibility("default"))) const KaustikImageFunctions*
kaustikImageFunctions() {
    return &kFunctions;
}
