// SPDX-License-Identifier: MIT
// The C boundary between the program and the modules that know formats of images:
// kaustik_openimageio.so, and kaustik_exr_png.so where OpenImageIO is not to be had. No memory
// changes owner across it and no exception crosses it: results and messages go back through calls.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// Raised with every change of the structs below, so that a stale module is refused.
inline constexpr std::uint32_t kKaustikImageModuleVersion = 3;
inline constexpr const char* kKaustikImageModuleSymbol = "kaustikImageFunctions";

// The functions that the module hands its results to. `context` is handed back to every call.
struct KaustikImageSink {
    void* context;
    // Room for width * height * channels floats (all at least 1), or null when there is none.
    float* (*allocate)(void* context, int width, int height, int channels);
    // The next bytes of an encoded file. False when they could not be kept.
    bool (*append)(void* context, const unsigned char* bytes, std::size_t count);
    // What went wrong, without the name of the file.
    void (*fail)(void* context, const char* message);
    // Of an image that is read with its layers: the name of the next channel, and a text of its
    // header. False when it could not be kept.
    bool (*channel)(void* context, const char* name);
    bool (*attribute)(void* context, const char* name, const char* value);
};

// The names of an image's channels, and the texts that its header holds.
struct KaustikImageLayers {
    const char* const* channels;  // as many as the image has
    std::size_t attributeCount;
    const char* const* attributeNames;
    const char* const* attributeValues;
};

// All functions return true when they succeeded; otherwise `fail` was called once.
struct KaustikImageFunctions {
    std::uint32_t version;
    // What it reads, for people: "EXR, PNG and more, through OpenImageIO".
    const char* formats;
    // Reads an image file of any format that the module knows.
    bool (*readFile)(const char* path, const KaustikImageSink* sink);
    // Reads an image file that is held in memory.
    bool (*readMemory)(const unsigned char* bytes, std::size_t count, const KaustikImageSink* sink);
    // An image as the bytes of an OpenEXR file: 32-bit float, ZIP compression, linear.
    bool (*encodeExr)(const float* values, int width, int height, int channels,
                      const KaustikImageSink* sink);
    // An image as the bytes of a PNG file: 8 bits, already display-encoded.
    bool (*encodePng)(const unsigned char* values, int width, int height, int channels,
                      const KaustikImageSink* sink);
    // Reads an OpenEXR file, however many channels it has, with their names.
    bool (*readLayers)(const char* path, const KaustikImageSink* sink);
    // The same as encodeExr with named channels.
    bool (*encodeLayers)(const float* values, int width, int height, int channels,
                         const KaustikImageLayers* layers, const KaustikImageSink* sink);
};

// The one symbol that the module exports.
using KaustikImageEntry = const KaustikImageFunctions* (*)();
}
