// SPDX-License-Identifier: MIT
// The module kaustik_openimageio.so: every image format that OpenImageIO 2.4 knows, behind the C
// boundary of module_interface.h. Values come and go as stored: no premultiplication by alpha,
// no colour conversion; 8- and 16-bit integers are read as [0,1].
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "framework/image/image_limits.h"
#include "framework/image/module_guard.h"

namespace {

using kaustik::guarded;
using kaustik::imageSizeProblem;

// OpenImageIO's messages may have several lines, and end in a period or not.
std::string oneLine(std::string message, const char* fallback) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    while (!message.empty() && (message.back() == '.' || message.back() == ' '))
        message.pop_back();
    return message.empty() ? fallback : message;
}

// Reads the first image of the file, through `proxy` where there is one.
void readFromProxy(const std::string& name, OIIO::Filesystem::IOProxy* proxy,
                   const KaustikImageSink* sink) {
    OIIO::ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    // Some readers take the proxy from the argument of open, others only from the hints.
    if (proxy != nullptr) hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    auto input = OIIO::ImageInput::open(name, &hints, proxy);
    if (!input) {
        throw std::runtime_error("it is damaged or no image (" +
                                 oneLine(OIIO::geterror(), "unknown kind of file") + ")");
    }
    const OIIO::ImageSpec spec = input->spec();
    const std::string problem = imageSizeProblem(spec.width, spec.height, spec.nchannels);
    if (!problem.empty()) throw std::runtime_error("it " + problem);
    if (spec.depth > 1) throw std::runtime_error("it is a volume, not an image");
    float* const values = sink->allocate(sink->context, spec.width, spec.height, spec.nchannels);
    if (values == nullptr) throw std::bad_alloc();
    const bool complete = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values);
    // A JPEG that is cut off reads "well", with grey where the rest was, and leaves a message.
    if (!complete || input->has_error()) {
        throw std::runtime_error("it is damaged or cut off (" +
                                 oneLine(input->geterror(), "its pixels end early") + ")");
    }
}

// OpenImageIO picks the reader by the file's name; bytes in memory have none, but all formats that
// a texture may come in begin with a signature.
const char* extensionOf(std::string_view bytes) {
    using namespace std::string_view_literals;
    struct Signature {
        std::string_view start;
        const char* extension;
    };
    static constexpr std::array kSignatures{
        Signature{"\x89PNG"sv, "png"},
        Signature{"\xff\xd8\xff"sv, "jpg"},
        Signature{"\x76\x2f\x31\x01"sv, "exr"},
        Signature{"#?"sv, "hdr"},
        Signature{"BM"sv, "bmp"},
        Signature{"GIF8"sv, "gif"},
        Signature{"II*\0"sv, "tif"},
        Signature{"MM\0*"sv, "tif"},
        Signature{"RIFF"sv, "webp"},
        Signature{"DDS "sv, "dds"},
    };
    for (const Signature& signature : kSignatures) {
        if (bytes.starts_with(signature.start)) return signature.extension;
    }
    return nullptr;
}

void encode(const char* extension, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
            const void* values, const KaustikImageSink* sink) {
    std::string name = fmt::format("memory.{}", extension);
    auto output = OIIO::ImageOutput::create(name);
    if (!output) throw std::runtime_error(oneLine(OIIO::geterror(), "no writer for it"));
    OIIO::Filesystem::IOVecOutput proxy;
    if (!output->set_ioproxy(&proxy)) throw std::runtime_error("it cannot be made in memory");
    if (!output->open(name, spec) || !output->write_image(type, values) || !output->close()) {
        throw std::runtime_error(oneLine(output->geterror(), "OpenImageIO gives no reason"));
    }
    output.reset();
    if (!sink->append(sink->context, proxy.buffer().data(), proxy.buffer().size())) {
        throw std::bad_alloc();
    }
}

bool readFile(const char* path, const KaustikImageSink* sink) {
    return guarded(sink, [&] { readFromProxy(path, nullptr, sink); });
}

bool readMemory(const unsigned char* bytes, std::size_t count, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        const char* const extension =
            extensionOf(std::string_view(reinterpret_cast<const char*>(bytes), count));
        if (extension == nullptr) {
            throw std::runtime_error(
                "it is damaged or no image (its first bytes are those of no "
                "known format; PNG and JPEG are always right)");
        }
        OIIO::Filesystem::IOMemReader proxy(bytes, count);
        readFromProxy(fmt::format("memory.{}", extension), &proxy, sink);
    });
}

bool encodeExr(const float* values, int width, int height, int channels,
               const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::FLOAT);
        spec["compression"] = "zip";
        // Else the time of writing goes in, and two equal pictures make different files.
        spec["DateTime"] = "1970:01:01 00:00:00";
        spec["oiio:ColorSpace"] = "Linear";
        encode("exr", spec, OIIO::TypeDesc::FLOAT, values, sink);
    });
}

bool encodePng(const unsigned char* values, int width, int height, int channels,
               const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
        spec["oiio:UnassociatedAlpha"] = 1;
        spec["oiio:ColorSpace"] = "sRGB";
        encode("png", spec, OIIO::TypeDesc::UINT8, values, sink);
    });
}

bool readLayers(const char* path, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        auto input = OIIO::ImageInput::open(path);
        if (!input) {
            throw std::runtime_error("it is damaged or no image (" +
                                     oneLine(OIIO::geterror(), "unknown kind of file") + ")");
        }
        const OIIO::ImageSpec spec = input->spec();
        const std::string problem =
            kaustik::layeredSizeProblem(spec.width, spec.height, spec.nchannels);
        if (!problem.empty()) throw std::runtime_error("it " + problem);
        if (spec.deep || spec.depth > 1)
            throw std::runtime_error("it is deep or a volume, not an image");
        float* const values =
            sink->allocate(sink->context, spec.width, spec.height, spec.nchannels);
        if (values == nullptr) throw std::bad_alloc();
        for (const std::string& name : spec.channelnames) {
            if (!sink->channel(sink->context, name.c_str())) throw std::bad_alloc();
        }
        for (const OIIO::ParamValue& value : spec.extra_attribs) {
            if (value.type() != OIIO::TypeDesc::STRING) continue;
            if (!sink->attribute(sink->context, value.name().c_str(), value.get_string().c_str()))
                throw std::bad_alloc();
        }
        const bool isComplete =
            input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values);
        if (!isComplete || input->has_error()) {
            throw std::runtime_error("it is damaged or cut off (" +
                                     oneLine(input->geterror(), "its pixels end early") + ")");
        }
    });
}

bool encodeLayers(const float* values, int width, int height, int channels,
                  const KaustikImageLayers* layers, const KaustikImageSink* sink) {
    return guarded(sink, [&] {
        OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::FLOAT);
        spec.channelnames.assign(layers->channels, layers->channels + channels);
        spec["compression"] = "zip";
        spec["DateTime"] = "1970:01:01 00:00:00";
        spec["oiio:ColorSpace"] = "Linear";
        for (std::size_t i = 0; i < layers->attributeCount; ++i)
            spec[layers->attributeNames[i]] = layers->attributeValues[i];
        encode("exr", spec, OIIO::TypeDesc::FLOAT, values, sink);
    });
}

constexpr KaustikImageFunctions kFunctions{kKaustikImageModuleVersion,
                                           "EXR, PNG and more, through OpenImageIO",
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
