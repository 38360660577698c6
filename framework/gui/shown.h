// SPDX-License-Identifier: MIT
// Whether the picture and the times in the window are of what is asked for, and if not why, and
// what can be done about it: the one line of the workbench that is always there.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/gui/document.h"
#include "framework/gui/frame_result.h"
#include "framework/gui/reference_worker.h"
#include "framework/gui/state.h"

namespace kaustik::gui {

struct Shown {
    enum class Kind {
        requested,   // what was asked for
        limited,     // the same, of which the technique itself says what it leaves out or joins
        rendering,   // something older, until what was asked for is rendered
        preview,     // the same view, quickly made
        impossible,  // what was asked for, and what no light can do
        stale        // something else, and that will not change by itself
    };
    Kind kind = Kind::requested;
    std::string sentence;

    // What ends a stale state.
    enum class Remedy {
        none,
        back,          // to the document that is shown
        forget,        // all settings
        defaultScene,  // instead of one that cannot be had
        picture,       // instead of a texture that there is not
        layer,         // the last one that there is
        restart        // the renderer
    };
    Remedy remedy = Remedy::none;
    // What the technique says of it: what it cannot form, joins, ignores; whole sentences.
    std::vector<std::string> reservations = {};
};

struct KeptVariant;
struct ImageDifference;

// What is to be seen.
struct ShownRequest {
    const Document& document;
    // The order that first asked for it; later ones may want more frames of the same picture.
    std::uint64_t order = 0;
    const ViewState& view;
    std::size_t edited = 0;  // variant: 0 A, 1 B
    const std::vector<KeptVariant>* kept = nullptr;
    std::shared_ptr<const ImageDifference> difference = {};  // where one is asked for
    // The one that is seen, to the left of the split where there is one.
    [[nodiscard]] std::size_t seen() const {
        return view.comparedWith == ComparedImage::other ||
                       (view.comparedWith == ComparedImage::difference && view.comparedKept < 0)
                   ? 0
                   : edited;
    }
    // The kept one that is seen in place of what was rendered last; null where none is.
    [[nodiscard]] const KeptVariant* flipped() const;
};

// Why the document cannot be rendered; "" where it can be, or where that is not known yet.
[[nodiscard]] std::string runObstacle(const ShownRequest& requested, const FrameResult& result);

// Whether every variant of the document has been rendered as it is asked for: then it can be done
// again elsewhere.
[[nodiscard]] bool isRendered(const ShownRequest& requested, const FrameResult& result);

// Whether the reference is of the document's view.
[[nodiscard]] bool hasSameView(const ReferenceState& reference, const Document& document);

// `whole`: the last document that was rendered without an error, where there was one.
[[nodiscard]] Shown shownOf(const ShownRequest& requested, const FrameResult& result,
                            const ReferenceState& reference, const std::optional<Document>& whole);

// "error", "preview" …: for the screen map.
[[nodiscard]] const char* nameOf(Shown::Kind kind);
// What the button says.
[[nodiscard]] std::string labelOf(Shown::Remedy remedy);

}  // namespace kaustik::gui
