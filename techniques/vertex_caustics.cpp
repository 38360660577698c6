// SPDX-License-Identifier: MIT
// Caustic maps with a photon a vertex: Shah, Konttinen, Pattanaik (SP05), as WD06 and WD08 compare
// with it.
#include "framework/pipeline/registry.h"

namespace kaustik {

void registerVertexCaustics(Registry& registry) {
    registry.technique({"vertex_caustics",
                        "Caustic maps with one photon a vertex of the specular objects.",
                        "Shah, Konttinen, Pattanaik (SP05)",
                        {{"specular", "two_interfaces"},
                         {"trace", "background"},
                         {"reconstruct.space", "light"},
                         {"gather", "project"},
                         {"view", "image_space"},
                         {"emit.photons", "512x512"},
                         {"emit", "vertices"},
                         {"trace.background.step", "distance"},
                         {"reconstruct", "fixed"}}});
}

}  // namespace kaustik
