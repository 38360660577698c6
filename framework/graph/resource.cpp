// SPDX-License-Identifier: MIT
#include "framework/graph/resource.h"

namespace kaustik::graph {

std::size_t bytesPerTexel(Format format) {
    switch (format) {
        case Format::r32f:
        case Format::r32ui:
        case Format::rgba8:
        case Format::depth32f:
            return 4;
        case Format::rg32f:
        case Format::rg32ui:
        case Format::rgba16f:
            return 8;
        case Format::rgba32f:
        case Format::rgba32ui:
            return 16;
    }
    return 0;
}

const char* formatName(Format format) {
    switch (format) {
        case Format::r32f:
            return "R32F";
        case Format::rg32f:
            return "RG32F";
        case Format::rgba32f:
            return "RGBA32F";
        case Format::rgba16f:
            return "RGBA16F";
        case Format::rgba8:
            return "RGBA8";
        case Format::r32ui:
            return "R32UI";
        case Format::rg32ui:
            return "RG32UI";
        case Format::rgba32ui:
            return "RGBA32UI";
        case Format::depth32f:
            return "DEPTH32F";
    }
    return "";
}

std::size_t TextureDesc::bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(layers == 0 ? 1 : layers) * bytesPerTexel(format);
}

std::size_t bytesOf(const ResourceDesc& desc) {
    return std::visit([](const auto& d) { return d.bytes(); }, desc);
}

}  // namespace kaustik::graph
