// SPDX-License-Identifier: MIT
#include "techniques/bibliography.h"

namespace kaustik {

void registerPapers(Registry& registry) {
    registry.paper({"K06",
                    "Krüger, Bürger, Westermann: *Interactive Screen-Space Accurate Photon Tracing "
                    "on GPUs*, Eurographics Symposium on Rendering 2006"});
    registry.paper({"W05",
                    "Wyman: *An Approximate Image-Space Approach for Interactive Refraction*, ACM "
                    "Transactions on Graphics 24(3), 2005; as K06 and WN09 describe it"});
    registry.paper({"SP05",
                    "Shah, Konttinen, Pattanaik: *Caustics Mapping: An Image-Space Technique for "
                    "Real-Time Caustics*, IEEE TVCG; as K06, WD08 and U08 describe it"});
    registry.paper({"WD06",
                    "Wyman, Davis: *Interactive Image-Space Techniques for Approximating "
                    "Caustics*, Symposium on Interactive 3D Graphics 2006; as WD08 describes it"});
    registry.paper({"WD08",
                    "Wyman, Dachsbacher: *Improving Image-Space Caustics via Variable-Sized "
                    "Splatting*, report of 2006, Journal of Graphics Tools 2008"});
    registry.paper({"W08",
                    "Wyman: *Hierarchical Caustic Maps*, Symposium on Interactive 3D Graphics "
                    "2008; as WN09 describes it"});
    registry.paper({"U08",
                    "Umenhoffer, Patow, Szirmay-Kalos: *Caustic Triangles on the GPU*, Computer "
                    "Graphics International 2008"});
    registry.paper({"W90",
                    "Watt: *Light-Water Interaction Using Backward Beam Tracing*, SIGGRAPH 1990; "
                    "by its abstract"});
    registry.paper(
        {"WN09",
         "Wyman, Nichols: *Adaptive Caustic Maps Using Deferred Shading*, Eurographics 2009"});
}

}  // namespace kaustik
