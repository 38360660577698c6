// SPDX-License-Identifier: MIT
// The panel Error: the reference in the background, and how wrong the frame is next to it.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "framework/image/image.h"
#include "tests/gui/workbench_fixture.h"

namespace kaustik::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ErrorPanel : public WorkbenchTest {
  protected:
    static json withPhotons(double photons) {
        json kept = savedStateWith(smallDocument());
        kept["panels"]["truth_photons"] = photons;
        return kept;
    }
    void untilJudged() {
        bench->waitFor("the error of this frame", [](const json& screen) {
            const json& controls = screen.at("controls");
            // A reference that fails ends the wait, and the test.
            return controls.at("error.problem").at("value") != "" ||
                   (!controls.contains("error.progress") && controls.contains("error.rmse") &&
                    controls.at("error.frame").at("value") == "new" &&
                    screen.at("status").at("judged_order") == screen.at("status").at("order"));
        });
        ASSERT_EQ(bench->value("error.problem"), "");
        untilSettled();
    }
    void computeReference() {
        open("Error");
        bench->click("error.compute");
        untilJudged();
    }
    [[nodiscard]] std::uint64_t photons() { return bench->status().at("truth_photons"); }
};

TEST_F(ErrorPanel, TheInterfaceGoesOnWhileAReferenceIsComputed) {
    start(withPhotons(2e8));
    open("Error");
    EXPECT_EQ(bench->value("error.reference"), "0");
    bench->click("error.compute");
    bench->waitFor("progress", [](const json& screen) {
        return screen.at("controls").contains("error.progress");
    });
    const int before = bench->screen().at("frame");
    bench->waitFor("twenty frames of the interface while it computes", [&](const json& screen) {
        return screen.at("controls").contains("error.progress") &&
               screen.at("frame").get<int>() > before + 20;
    });
    // What there is so far is shown and judged already.
    bench->waitFor("an error while it computes", [](const json& screen) {
        return screen.at("controls").contains("error.progress") &&
               screen.at("controls").contains("error.rmse");
    });
    bench->keepScreenshot("error-computing");
    // And the picture answers.
    const json camera = document().at("edits");
    bench->drag("picture", 30, 0);
    EXPECT_NE(document().at("edits"), camera);
    // Nobody computes the other view's any more, and that is said.
    bench->waitFor("the end of the work", [](const json& screen) {
        return screen.at("controls").contains("error.compute");
    });
    EXPECT_TRUE(says("status.message", "computing it has ended")) << bench->value("status.message");
    bench->key("r");
}

// However long a batch of photons takes, and whatever the frame at hand: what is seen two frames of
// the interface after the press (untilTaken) is the answer to it.
TEST_F(ErrorPanel, ComputeAndStopAreAnsweredAtOnce) {
    json kept = withPhotons(1e10);
    kept["document"]["size"] = {800, 600};
    start(kept);
    open("Error");
    bench->waitFor("the button", [](const json& screen) {
        return screen.at("controls").contains("error.compute");
    });
    bench->click("error.compute");
    const json pressed = bench->screen();
    EXPECT_TRUE(pressed.at("controls").contains("error.progress"));
    EXPECT_EQ(pressed.at("status").at("truth_photons"), 0) << "long before there are any";
    bench->waitFor("progress within the first batch", [](const json& screen) {
        EXPECT_EQ(screen.at("status").at("truth_photons"), 0);
        return std::stod(
                   screen.at("controls").at("error.progress").at("value").get<std::string>()) > 0.0;
    });
    bench->click("error.stop");
    const json stopped = bench->screen().at("controls");
    EXPECT_TRUE(stopped.contains("error.compute") ||
                stopped.at("error.stop").at("value") == "stopping");
    bench->waitFor("the end of the work", [](const json& screen) {
        return screen.at("controls").contains("error.compute");
    });
    EXPECT_EQ(photons(), 0u) << "the first batch was ended in its middle";
}

TEST_F(ErrorPanel, TheProgressOfAReferenceNeverGoesBack) {
    start(withPhotons(3e6));
    open("Error");
    bench->click("error.compute");
    double maximum = 0.0;
    std::set<double> seen;
    bench->waitFor("the end of the work", [&](const json& screen) {
        const json& controls = screen.at("controls");
        if (!controls.contains("error.progress")) return true;
        const double share =
            std::stod(controls.at("error.progress").at("value").get<std::string>());
        EXPECT_GE(share, maximum);
        EXPECT_LE(share, 1.0);
        maximum = share;
        seen.insert(share);
        return false;
    });
    EXPECT_GT(seen.size(), 3u);
    EXPECT_GE(photons(), 3000000u);
    // Both references are in it.
    untilJudged();
    EXPECT_TRUE(bench->has("error.modelled.rmse"));
}

TEST_F(ErrorPanel, AReferenceThatIsStoppedStaysAndGoesOnLater) {
    start(withPhotons(1e10));
    open("Error");
    bench->click("error.compute");
    bench->waitFor("a first part", [](const json& screen) {
        return screen.at("status").at("truth_photons").get<std::uint64_t>() > 0;
    });
    bench->click("error.stop");
    bench->waitFor("the end of the work", [](const json& screen) {
        return screen.at("controls").contains("error.compute");
    });
    const std::uint64_t stopped = photons();
    EXPECT_GT(stopped, 0u);
    endByClosing();

    startAgain();
    open("Error");
    bench->waitFor("the reference of before", [&](const json& screen) {
        return screen.at("status").at("truth_photons").get<std::uint64_t>() >= stopped;
    });
    bench->click("error.compute");
    bench->waitFor("a better reference", [&](const json& screen) {
        return screen.at("status").at("truth_photons").get<std::uint64_t>() > stopped;
    });
    // Closing in the middle loses nothing of it.
    const std::uint64_t reached = photons();
    endByClosing();
    startAgain();
    bench->waitFor("the reference of before", [&](const json& screen) {
        return screen.at("status").at("truth_photons").get<std::uint64_t>() >= reached;
    });
}

// Whether or not a photon was added until then.
TEST_F(ErrorPanel, GoingOnAndStoppingAtOnceLeavesTheErrors) {
    start();
    computeReference();
    bench->typeInto("error.photons", "10000", Entry::controlClick, "Return", {0.2, 0.5});
    bench->click("error.compute");
    bench->click("error.stop");
    untilJudged();
    EXPECT_TRUE(bench->has("error.rmse"));
}

TEST_F(ErrorPanel, TheErrorsAreThoseOfARunAgainstTheSameReference) {
    start();
    computeReference();
    bench->keepScreenshot("error");
    EXPECT_GE(photons(), 1000000u);
    const auto times = [&] {
        std::map<std::string, fs::file_time_type> found;
        // What the eye sees is kept there too, by runs alone.
        for (const auto& entry : fs::directory_iterator(folder / "cache/references")) {
            if (entry.path().extension() != ".view")
                found[entry.path().filename()] = entry.last_write_time();
        }
        return found;
    };
    const auto before = times();
    renderSmall({"--reference", "auto", "--reference-photons", "1000000", "--out", "judged"});
    EXPECT_EQ(times(), before) << "the run takes the reference that the workbench has computed";
    const json error = readJson("judged/report.json").at("error");
    const auto expectSame = [&](const json& errors, const std::string& prefix) {
        for (const char* key :
             {"rmse", "rel_mse", "smape", "mae", "ssim", "flip_hdr", "energy_ratio"}) {
            EXPECT_EQ(bench->value(prefix + key),
                      fmt::format("{:.4g}", errors.at("caustic_irradiance").at(key).get<double>()))
                << prefix << key;
        }
    };
    expectSame(error, "error.");
    expectSame(error.at("modelled_paths"), "error.modelled.");
}

TEST_F(ErrorPanel, AWorseFrameHasALargerError) {
    start();
    computeReference();
    const double before = std::stod(bench->value("error.rmse"));
    open("Parameters");
    bench->typeInto("parameter.layers.count", "1", Entry::controlClick);
    open("Error");
    untilJudged();
    EXPECT_GT(std::stod(bench->value("error.rmse")), 1.5 * before) << "the floor is not found";
}

// Picture, caption and numbers belong together on each side of a split, also where one side fills
// the whole window.
TEST_F(ErrorPanel, OnEachSideOfASplitWordsAndNumbersAreThoseOfThePixels) {
    json kept = withPhotons(1e6);
    kept["view"]["compared_with"] = 2;
    kept["view"]["looks"]["caustic.irradiance"] = {{"exposure_automatic", false},
                                                   {"exposure", -11.0}};
    start(kept);
    computeReference();
    untilSettled();
    renderSmall({"--save", "caustic.irradiance", "--reference", "auto", "--reference-photons",
                 "1000000", "--out", "saved"});
    const Image ours = readImage(folder / "saved" / ("caustic.irradiance" + floatImageExtension()));
    const Image truth = readImage(folder / "saved" / ("reference" + floatImageExtension()));
    const auto valueAt = [&](int x, int y) {
        bench->hover("picture.image", pixel(x, y));
        const std::string text = bench->value("picture.value");
        return std::stod(text.substr(text.find("red ") + 4));
    };
    // The grey that is seen of a value, sRGB.
    const auto seenOf = [](float value) {
        const double linear = std::min(static_cast<double>(value) / 2048.0, 1.0);
        return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    };
    for (const auto& [x, y] : {std::pair{24, 30}, std::pair{38, 27}}) {
        const Image& expected = x < 32 ? ours : truth;
        EXPECT_NEAR(valueAt(x, y), static_cast<double>(expected.at(x, y, 0)),
                    1e-4 * static_cast<double>(expected.at(x, y, 0)) + 1e-6)
            << x;
        ASSERT_NE(ours.at(x, y, 0), truth.at(x, y, 0)) << "else nothing is told apart";
        const Image seen = seenPicture();
        const int scale = seen.width / 64;
        EXPECT_NEAR(static_cast<double>(seen.at(x * seen.width / 64 + scale / 2,
                                                y * seen.height / 48 + scale / 2, 0)),
                    seenOf(expected.at(x, y, 0)), 1.5 / 255.0)
            << x;
    }
    EXPECT_TRUE(bench->value("picture.caption").starts_with("caustic.irradiance"));
    EXPECT_TRUE(bench->value("picture.caption.compared").starts_with("reference: "));
    EXPECT_TRUE(says("picture.caption.compared", "its own noise"));
    // Right of the split all is the reference's.
    bench->hover("picture.image", pixel(50, 30));
    const double x = bench->control("picture.image").x;
    bench->wheel("picture.image", 12, pixel(50, 30));
    ASSERT_LT(bench->control("picture.image").x, x);
    EXPECT_FALSE(bench->has("picture.caption"));
    EXPECT_TRUE(bench->value("picture.caption.compared").starts_with("reference: "));
    EXPECT_TRUE(bench->has("picture.values"));
    bench->keepScreenshot("error-right-of-the-split");
}

TEST_F(ErrorPanel, TheErrorAndTheReferenceAreSeenNextToThePicture) {
    start();
    computeReference();
    renderSmall({"--save", "caustic.irradiance", "--reference", "auto", "--reference-photons",
                 "1000000", "--out", "saved"});
    const Image ours = readImage(folder / "saved" / ("caustic.irradiance" + floatImageExtension()));
    const Image truth = readImage(folder / "saved" / ("reference" + floatImageExtension()));
    bench->hover("picture.image", pixel(24, 30));
    const std::string before = bench->value("picture.value");
    bench->click("error.heat_map");
    untilSettled();
    ASSERT_TRUE(bench->has("picture.split"));
    bench->keepScreenshot("error-heat-map");
    bench->hover("picture.image", pixel(24, 30));
    EXPECT_EQ(bench->value("picture.value"), before);
    EXPECT_TRUE(bench->value("picture.caption.compared").starts_with("error: "));
    EXPECT_TRUE(bench->has("picture.bar.compared"));
    // A value with its sign, and no colour.
    bench->hover("picture.image", pixel(38, 27));
    const std::string text = bench->value("picture.value");
    double error = 0.0;
    for (int c = 0; c < 3; ++c) {
        error +=
            (static_cast<double>(ours.at(38, 27, c)) - static_cast<double>(truth.at(38, 27, c))) /
            3.0;
    }
    ASSERT_NE(text.find("error "), std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(text.find("error ") + 6)), error,
                1e-4 * std::abs(error) + 1e-3);
    EXPECT_TRUE(text.ends_with("W/m²"));
    bench->click("error.heat_map");
    EXPECT_FALSE(bench->has("picture.split"));

    open("Image");
    choose("image.compared_with", "the reference");
    untilSettled();
    ASSERT_TRUE(bench->has("picture.split"));
    bench->keepScreenshot("error-reference");
    // Irradiance on both sides: where the sun shines straight on the floor there is none of it.
    bench->hover("picture.image", pixel(50, 44));
    const std::string lit = bench->value("picture.value");
    EXPECT_TRUE(lit.starts_with("(50, 44)  red 0  green 0  blue 0 W/m²")) << lit;
}

TEST_F(ErrorPanel, TheLedgerClosesAndSaysWhatItsRowsAre) {
    start();
    open("Error");
    EXPECT_TRUE(says("error.account.emitted", "the lights send onto"));
    const json controls = bench->screen().at("controls");
    int rows = 0;
    for (const auto& [name, control] : controls.items()) {
        if (!name.starts_with("error.account.")) continue;
        EXPECT_NE(control.at("value"), "") << name;
        ++rows;
    }
    EXPECT_GE(rows, 4);
    EXPECT_LT(std::abs(std::stod(bench->value("error.balance"))), 1e-6);
}

}  // namespace
}  // namespace kaustik::test
