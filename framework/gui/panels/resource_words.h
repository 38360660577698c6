// SPDX-License-Identifier: MIT
// What panels say of a texture or a buffer of the frame next to its name.
#pragma once

#include <string>
#include <vector>

#include "framework/gui/bench.h"

namespace kaustik::gui {

// "800x600x8 RGBA32F"; with bytes for a buffer; "" for what the frame does not have.
[[nodiscard]] std::string sizeAndFormat(const VariantResult& result, const std::string& resource);
// "W/m²" of all channels, "m, m²" of several; "" for plain numbers and for buffers.
[[nodiscard]] std::string unitsOf(const VariantResult& result, const std::string& resource);
// Who writes it: "trace.bvh", "layers.peel, layers.lists"; "nothing in this frame".
[[nodiscard]] std::string writersText(const VariantResult& result, const std::string& resource);

[[nodiscard]] const ListedTexture* findTexture(const VariantResult& result,
                                               const std::string& name);

// Parts of a texture that are textures of their own, as mips; empty where it is one whole.
[[nodiscard]] std::vector<ViewedTexture::Region> partsOf(const VariantResult& result,
                                                         const std::string& name);

// Shows a texture on the canvas, whole or one of its parts.
void openTexture(Bench& bench, const std::string& name, const std::string& part = "");

}  // namespace kaustik::gui
