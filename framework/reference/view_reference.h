// SPDX-License-Identifier: MIT
// What the eye sees in and through specular surfaces, ray traced: for every pixel the exact path of
// the transmitted ray, and the radiance that arrives at the eye by all paths. Caustics are left out
// of the radiance: receivers have their direct and their fill light, everything specular blocks
// direct light, and what leaves the scene sees the environment (Appearance::environment).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "framework/image/image.h"
#include "framework/reference/embree_scene.h"

namespace kaustik::reference {

struct ViewReferenceRequest {
    int width = 800;
    int height = 600;
    int samplesPerSide = 4;     // of a pixel's square, jittered: its box filter
    int splitInteractions = 2;  // both parts are followed; at later ones one, by its share
    int maximumInteractions = 64;
    std::uint64_t seed = 1;
    int threads = 0;  // 0: all
};

// Rows from the top. Only pixels whose middle sees a specular surface are known; others are 0.
struct ViewReference {
    // The path through the pixel's middle: refracted at every dielectric unless all is reflected.
    Image
        exitPosition;  // where it leaves the last specular surface: view space, m; how many it hit
    Image exitDirection;     // unit, view space; 1 where it came out, 0 at the limit
    Image radiance;          // mean over the pixel, W/m²/sr
    Image radianceError;     // its standard error
    Image mask;              // 1 where the pixel's middle sees a specular surface
    std::size_t pixels = 0;  // of these
    void countPixels();
};
// Of the request's size; nothing is seen.
[[nodiscard]] ViewReference emptyView(const ViewReferenceRequest& request);

[[nodiscard]] ViewReference traceView(const EmbreeScene& scene,
                                      const ViewReferenceRequest& request);

// The same, kept in a folder: traced where it is not there. `report` is told of a file that is
// damaged, which is made again, or that cannot be written.
[[nodiscard]] ViewReference loadOrTraceView(const EmbreeScene& scene,
                                            const ViewReferenceRequest& request,
                                            const std::filesystem::path& cacheFolder,
                                            const std::function<void(const std::string&)>& report);

}  // namespace kaustik::reference
