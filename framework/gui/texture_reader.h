// SPDX-License-Identifier: MIT
// Reads textures of a frame for the window, as what they hold: sums in fixed point as light, the
// faces of a cube as a cross, and with names for what each layer is of.
#pragma once

#include <string>

#include "framework/gui/frame_result.h"
#include "framework/pipeline/renderer.h"

namespace kaustik::gui {

// The picture of the frame that was rendered last; waits for the device, as all here.
[[nodiscard]] ViewedTexture readPicture(const Renderer& renderer);
// A texture that has been kept; the picture where the graph has no such texture, and no values
// where it has no such layer (ViewedTexture::missing).
[[nodiscard]] ViewedTexture readViewed(const Renderer& renderer, const std::string& name,
                                       int layer);

// The same with every n-th pixel alone, so that no side is longer than `side`, and histograms
// of these.
[[nodiscard]] ViewedTexture reducedTo(ViewedTexture viewed, int side);

// The cross of six faces (+x, -x, +y, -y, +z, -z) of one size, 4 by 3 faces, seen from within; what
// is no face is 0.
[[nodiscard]] Image unfoldCube(const std::vector<Image>& faces);
[[nodiscard]] std::vector<ViewedTexture::Region> regionsOfCube(int side);

// Of a pyramid of planes over a view of so many pixels its mips by name, "squares of 4 pixels", as
// shaders/layered_depth/pyramid_layout.glsl places them.
[[nodiscard]] std::vector<ViewedTexture::Region> regionsOfPyramid(int width, int height);
// The texture of the view that such a one is over; "" where the name is of no pyramid.
[[nodiscard]] std::string pixelsOfPyramid(const std::string& name);

// Light of the words of sums in fixed point (transport::kFluxWords, low before high, by channel),
// times what one unit of them is.
[[nodiscard]] Image lightOfSums(const std::vector<Image>& words, double unit);

}  // namespace kaustik::gui
