// SPDX-License-Identifier: MIT
// One way to render on the renderer's thread: builds what is asked for, renders frames that are
// timed, and reads back what the window shows.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/gui/frame_result.h"
#include "framework/run/session.h"

namespace kaustik::gui {

// What the window wants to see of a frame.
struct Viewing {
    std::string resource;  // "": the picture
    int layer = 0;
    bool readsOutputs = false;  // VariantResult::outputs
    std::string pass = {};      // whose textures are wanted as thumbnails; "": of none
    friend bool operator==(const Viewing&, const Viewing&) = default;
    // Whether it is the same but for thumbnails, for which alone no frame is rendered.
    [[nodiscard]] bool wantsSameFrame(const Viewing& other) const {
        return resource == other.resource && layer == other.layer &&
               readsOutputs == other.readsOutputs;
    }
};

class VariantRenderer {
  public:
    // Asked before each pass, with its number, how many there are, and its name.
    using ShouldContinue = std::function<bool(std::size_t, std::size_t, const std::string&)>;

    // All of these outlive the renderer. `versions` counts the textures that were read back.
    VariantRenderer(gl::Context& context, const Registry& registry, scene::Scene& scene,
                    std::uint64_t& versions)
        : context_(context), registry_(registry), scene_(scene), versions_(versions) {}

    // Renders a frame of the variant and reads it back into result(). False: it was ended early,
    // and the result is the one before. What is wrong with the variant becomes the result's error;
    // only a DeviceError is thrown.
    bool render(const Variant& variant, const params::Extent& size, const Viewing& viewing,
                bool isPrecise, const ShouldContinue& shouldContinue);
    // Renders a smaller picture without caustics, for a view that is being turned. It is not timed.
    bool renderPreview(const Variant& variant, const params::Extent& size,
                       const ShouldContinue& shouldContinue);
    // Renders one more frame of what was rendered last, for the ledger, the limits and thumbnails.
    // Where there is room for all of its textures, look() finds them from then on.
    bool measure(const Viewing& viewing, const ShouldContinue& shouldContinue);
    // Whether the frame that was measured last has what is to be seen, and nothing was rendered
    // since.
    [[nodiscard]] bool canLook(const Viewing& viewing) const;
    // Reads that back into result(), without rendering.
    void look(const Viewing& viewing);
    // Renders one more frame for the photons that landed at a pixel.
    [[nodiscard]] std::optional<PhotonProbe> probe(glm::ivec2 pixel, float radius,
                                                   const ShouldContinue& shouldContinue);

    [[nodiscard]] const VariantResult& result() const { return result_; }
    [[nodiscard]] VariantResult& result() { return result_; }
    // Programs that cannot be compiled any more; the others are replaced.
    [[nodiscard]] std::vector<std::string> reloadShaders();
    // The scene's lights, camera, time … have changed.
    void noteSceneChange() {
        if (session_) session_->noteSceneChange();
    }

  private:
    void select(const Variant& variant, const params::Extent& size);
    void keep(const Viewing& viewing);
    void readBack(const Viewing& viewing);
    [[nodiscard]] ViewedTexture view(const Viewing& viewing);
    void readThumbnails(const std::string& pass);
    [[nodiscard]] std::vector<std::string> texturesWithRoom() const;
    bool guarded(const std::function<bool()>& work);
    [[nodiscard]] run::ShouldContinue stepwise(const ShouldContinue& shouldContinue) const;

    gl::Context& context_;
    const Registry& registry_;
    scene::Scene& scene_;
    std::uint64_t& versions_;
    Variant variant_;
    params::Extent size_;
    std::shared_ptr<const PictureOrigin> origin_;  // of these
    std::optional<run::Session> session_;  // of these two, once something was to be rendered
    VariantResult result_;
    bool isMeasured_ = false;         // by the frame that was rendered last
    std::set<std::string> readable_;  // textures that hold their contents then
};

}  // namespace kaustik::gui
