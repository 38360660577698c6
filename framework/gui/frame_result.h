// SPDX-License-Identifier: MIT
// What the renderer's thread tells the window: values that no longer change, so that both
// may read them at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/gl/context.h"
#include "framework/gui/document.h"
#include "framework/gui/histogram.h"
#include "framework/gui/photon_probe.h"
#include "framework/gui/texture_content.h"
#include "framework/image/image.h"
#include "framework/measure/finite.h"
#include "framework/report/limits.h"
#include "framework/report/run_report.h"
#include "framework/scene/scene.h"

namespace kaustik::run {
struct Outputs;
}

namespace kaustik::gui {

struct ListedTexture {
    std::string name;
    graph::TextureDesc desc;
};

struct ListedBuffer {
    std::string name;
    std::size_t bytes = 0;
};

// What was rendered when a picture was made, whatever is set up since.
struct PictureOrigin {
    std::string scene;  // its name
    Variant variant;
    params::Extent size;
};

// One layer of a texture, read back: sums put together, the faces of a cube unfolded.
struct ViewedTexture {
    std::string name;           // of the resource; "" where it is the picture
    std::uint64_t version = 0;  // no other texture has it
    bool isEncoded = false;     // display-encoded, not linear
    TextureContent content;
    std::string place;  // that it is of: "the view of light 'sun'"
    int layer = 0;
    std::vector<std::string> layerNames;  // of all layers; empty where there is one
    Image values;                         // as many channels as the content, top row first
    // A part of the image that is a view of its own, pixels; what is in none is no value.
    struct Region {
        std::string name;
        int x = 0;
        int y = 0;
        int width = 0;
        int height = 0;
    };
    std::vector<Region> regions;  // empty: all of it is one
    // What was asked for and is not there; the picture is shown in the place of another texture,
    // and nothing in the place of a layer.
    enum class Missing { none, texture, layer };
    Missing missing = Missing::none;
    int layers = 1;  // of the texture
    // The texture whose values were looked at: the picture has none but colours, so that it is what
    // the picture is made of.
    std::string checked;
    std::optional<measure::NotFinite> notFinite;
    std::shared_ptr<Histograms> histograms = std::make_shared<Histograms>();  // of the values
    std::shared_ptr<const PictureOrigin> origin;                              // null of thumbnails
};

// What was rendered of one of the two variants.
struct VariantResult {
    std::uint64_t frame = 0;     // counts the frames of this variant
    std::uint64_t previews = 0;  // the same
    std::uint64_t order = 0;     // that the newest of them answers
    std::string error;           // why there is no newer picture; "" where all is well
    bool isPreview = false;      // smaller, and without caustics
    // Passes that the variant switches off and that it does not have: they were left out of it.
    std::vector<std::string> absentPasses;
    bool isSettled = false;  // the order's frames are done: nothing will change any more
    std::vector<graph::PassRecord> passes;
    std::vector<report::PassTimes> times;  // of the newest frames, oldest first
    std::vector<double> frameMs;
    std::vector<ListedTexture> textures;
    std::vector<ListedBuffer> buffers;
    std::optional<ViewedTexture> viewed;
    // Picture and caustic irradiance of a settled frame, whatever is viewed.
    std::vector<std::shared_ptr<const ViewedTexture>> outputTextures;
    // Of the textures of a settled frame that the pass that was asked for reads or writes, the
    // first layer, as they are at the frame's end; with so few pixels that they are for looking
    // alone.
    std::string thumbnailsOf;  // "": of none
    std::vector<std::shared_ptr<const ViewedTexture>> thumbnails;
    std::vector<std::string> warnings;
    std::size_t peakBytes = 0;
    // What a further frame has measured, which is rendered once the order is settled.
    std::optional<EnergyLedger> ledger;
    std::vector<ReachedLimit> limits;
    std::vector<std::string> violations;          // of the ledger
    std::shared_ptr<const run::Outputs> outputs;  // where asked for
    ModelledPaths paths;
};

// What the window needs to know of a scene that it has not loaded itself.
struct SceneFacts {
    std::string name;
    std::string description;
    std::size_t triangles = 0;
    // What the scene needs, with the changes of the document that was rendered.
    scene::SceneNeeds needs;
    scene::Bounds bounds;
    // From here on all is as the scene's file says; the document at hand may say otherwise (Bench).
    scene::Camera camera;
    std::vector<scene::Light> lights;
    std::optional<scene::Medium> medium;
    double timeSeconds = 0.0;
    struct Water {
        std::string object;
        std::vector<scene::Wave> waves;
    };
    std::vector<Water> waters;
};

struct FrameResult {
    std::uint64_t order = 0;    // that it answers
    Document document;          // of that order
    std::string problem;        // with scene or device, so that there is no frame at all; else ""
    bool isLost = false;        // the device is gone: only another worker can go on
    int shaderReloads = 0;      // frames before one are of other shaders
    std::string shaderProblem;  // the programs that failed to reload; the last good ones are used
    gl::DeviceInfo device;
    std::shared_ptr<const SceneFacts> scene;
    std::array<VariantResult, 2> variants;  // A, and B where the document has one
    std::optional<PhotonProbe> probe;
};

}  // namespace kaustik::gui
