// SPDX-License-Identifier: MIT
// Shaders that are edited while their picture is looked at: values that are no numbers, and errors.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "framework/image/image.h"
#include "tests/gui/shader_copies.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

// What composes the receivers' radiance for a `pixel`, edited while it is looked at.
class EditedShaders : public WorkbenchTest {
  protected:
    // Puts a line at its beginning.
    void edit(const std::string& line) const {
        shaders.write(kShader,
                      original.substr(0, place()) + line + "\n" + original.substr(place()));
    }
    [[nodiscard]] long lineOfEdit() const {
        return 1 +
               std::count(original.begin(), original.begin() + static_cast<long>(place()), '\n');
    }
    [[nodiscard]] std::size_t place() const {
        return original.find('\n', original.find("ivec2 pixel = ")) + 1;
    }
    void start(const std::string& resource = "compose.receiver_radiance") {
        json kept = savedStateShowing(resource);
        kept["view"]["looks"][resource] = {{"exposure_automatic", false},
                                           {"exposure", -8.0}};  // up to 256 W/m²/sr are told apart
        WorkbenchTest::start(kept, shaders.environment());
        open("Image");
    }
    void untilShaderIs(bool isBroken) {
        bench->waitFor(isBroken ? "the shader's error" : "a mended shader",
                       [&](const json& screen) {
                           return screen.at("controls").contains("status.shader") == isBroken;
                       });
    }
    void untilNotFinite(const std::string& count) {
        bench->waitFor("so many values that are not finite: " + count, [&](const json& screen) {
            return screen.at("controls").at("image.not_finite").at("value") == count;
        });
    }
    // A column of NaN in red, half of it of infinity in green: 48 + 24 values.
    static constexpr const char* kNotFinite =
        "if (pixel.x == 5) {\n"
        "    radiance = vec4(intBitsToFloat(0x7fc00000), 1.0, 1.0, 1.0);\n"
        "    if (pixel.y % 2 == 0) radiance.g = intBitsToFloat(0x7f800000);\n"
        "    return;\n"
        "}";

    static constexpr const char* kShader = "compose/picture_radiance.frag";
    ShaderCopies shaders{folder / "root"};
    std::string original = shaders.read(kShader);
};

TEST_F(EditedShaders, ValuesThatAreNoNumbersAreFlaggedAndCounted) {
    start();
    EXPECT_EQ(bench->value("image.not_finite"), "0");
    edit(kNotFinite);
    untilNotFinite("72");
    bench->keepScreenshot("image-not-finite");
    edit("");
    untilNotFinite("0");
}

// Whose own values are colours, of which all are numbers.
TEST_F(EditedShaders, ThePictureOfSuchValuesIsNotSaidToBeFinite) {
    start("");
    EXPECT_EQ(bench->value("image.not_finite"), "0");
    edit(kNotFinite);
    // As many, or more where they are seen through the water, too.
    bench->waitFor("values that are not finite", [](const json& screen) {
        return std::stoi(
                   screen.at("controls").at("image.not_finite").at("value").get<std::string>()) >=
               72;
    });
    bench->keepScreenshot("image-not-finite-picture");
}

TEST_F(EditedShaders, ABrokenShaderIsExplainedAndTheLastGoodOneStaysInUse) {
    start();
    const Image before = seenPicture();
    edit("radiance = noSuchThing;");
    untilShaderIs(true);
    EXPECT_TRUE(says("status.shader", "shaders/compose/picture_radiance.frag"));
    EXPECT_TRUE(says("status.shader", fmt::format(":{}:", lineOfEdit())))
        << bench->value("status.shader");
    EXPECT_TRUE(says("status.shader", "noSuchThing"));
    untilSettled();
    EXPECT_EQ(largestDifference(seenPicture(), before), 0.0);
    bench->keepScreenshot("image-broken-shader");
    edit("radiance = vec4(64.0); return;");
    untilShaderIs(false);
    untilSettled();
    const Image grey = seenPicture();
    EXPECT_EQ(std::count(grey.values.begin(), grey.values.end(), grey.values.front()),
              static_cast<std::ptrdiff_t>(grey.values.size()));
    edit("");
    bench->waitFor("the picture of before",
                   [&](const json&) { return largestDifference(seenPicture(), before) == 0.0; });
}

}  // namespace
}  // namespace kaustik::test
