// SPDX-License-Identifier: MIT
#include "framework/gui/shown.h"

#include <gtest/gtest.h>

namespace kaustik::gui::test {
namespace {

constexpr std::uint64_t kOrder = 7;

// A document whose order was rendered as it stands.
class ShownTest : public testing::Test {
  protected:
    ShownTest() {
        result.order = kOrder;
        render(result.variants[0]);
        render(result.variants[1]);
    }
    static void render(VariantResult& variant) {
        variant.order = kOrder;
        variant.viewed.emplace();
    }
    void addOther() {
        document.other = document.variant;
        result.document = document;
    }
    [[nodiscard]] ShownRequest requested() const { return {document, kOrder, view}; }
    [[nodiscard]] Shown shown() const { return shownOf(requested(), result, reference, whole); }
    [[nodiscard]] bool says(const std::string& part) const {
        return shown().sentence.find(part) != std::string::npos;
    }

    Document document;
    ViewState view;
    FrameResult result;
    ReferenceState reference;
    std::optional<Document> whole;
};

TEST_F(ShownTest, IsWhatWasAskedFor) {
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
    EXPECT_EQ(shown().remedy, Shown::Remedy::none);
    EXPECT_TRUE(isRendered(requested(), result));
    addOther();
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
    EXPECT_TRUE(isRendered(requested(), result));
}

TEST_F(ShownTest, IsRedOverWhatNoLightCanDo) {
    result.variants[0].violations = {"Energy is not conserved."};
    EXPECT_EQ(shown().kind, Shown::Kind::impossible);
    EXPECT_TRUE(says("Energy is not conserved."));
    // It can still be done again elsewhere.
    EXPECT_TRUE(isRendered(requested(), result));
}

TEST_F(ShownTest, IsNotGreenOverWhatTheTechniqueItselfDoesNotForm) {
    result.variants[0].warnings = {"It joins nothing."};
    EXPECT_EQ(shown().kind, Shown::Kind::limited);
    EXPECT_TRUE(says("a reservation: It joins nothing."));
    ReachedLimit limit;
    limit.parameter = "specular.bounces";
    limit.value = 8.0;
    result.variants[0].limits.push_back(limit);
    EXPECT_TRUE(says("2 reservations"));
    ASSERT_EQ(shown().reservations.size(), 2u);
    EXPECT_NE(shown().reservations[1].find("specular.bounces = 8"), std::string::npos);
    EXPECT_TRUE(isRendered(requested(), result));
}

TEST_F(ShownTest, IsOfBeforeUntilTheNewestOrderIsRendered) {
    result.order = kOrder - 1;
    result.variants[0].order = kOrder - 1;
    EXPECT_EQ(shown().kind, Shown::Kind::rendering);
    EXPECT_FALSE(isRendered(requested(), result));
    // The order is known, and its frame is on its way.
    result.order = kOrder;
    EXPECT_EQ(shown().kind, Shown::Kind::rendering);
    // What went wrong with an older order is over.
    result.variants[0].error = "an old mistake";
    EXPECT_EQ(shown().kind, Shown::Kind::rendering);
    EXPECT_EQ(runObstacle(requested(), result), "");
}

// As when it turns out that a frame takes long, and fewer are wanted.
TEST_F(ShownTest, IsWhatWasAskedForAlsoIfMoreFramesOfItAreWanted) {
    result.order = kOrder + 1;
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
    result.variants[0].order = kOrder + 1;
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
    EXPECT_TRUE(isRendered(requested(), result));
    result.variants[0].error = "No.";
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
}

TEST_F(ShownTest, IsOfBeforeUntilBothVariantsAreRendered) {
    addOther();
    result.variants[1].order = kOrder - 1;
    EXPECT_EQ(shown().kind, Shown::Kind::rendering);
    EXPECT_FALSE(isRendered(requested(), result));
}

TEST_F(ShownTest, IsAQuickPictureWhileTheViewIsTurned) {
    result.variants[0].isPreview = true;
    EXPECT_EQ(shown().kind, Shown::Kind::preview);
    EXPECT_FALSE(isRendered(requested(), result));
    result.order = kOrder - 1;
    EXPECT_EQ(shown().kind, Shown::Kind::preview);
}

TEST_F(ShownTest, IsStaleWhereAVariantCannotBeRendered) {
    result.variants[0].error = "There is no pass 'x'.\nNor 'y'.";
    document.variant.disabled = {"x"};
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
    EXPECT_TRUE(says(": There is no pass 'x'. Nor 'y'.")) << "in one line";
    EXPECT_EQ(shown().remedy, Shown::Remedy::forget) << "nothing to go back to";
    EXPECT_FALSE(isRendered(requested(), result));
    EXPECT_NE(runObstacle(requested(), result), "");
    whole = Document();
    EXPECT_EQ(shown().remedy, Shown::Remedy::back);
    // Also where a quick picture is all that there is.
    result.variants[0].isPreview = true;
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
}

TEST_F(ShownTest, NamesTheVariantThatCannotBeRendered) {
    addOther();
    result.variants[1].error = "No.";
    EXPECT_TRUE(says("B: No."));
    EXPECT_EQ(runObstacle(requested(), result), "B: No.");
    // One that the document does not have is no reason.
    document.other.reset();
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
}

TEST_F(ShownTest, IsStaleWhereTheSceneCannotBeHad) {
    document.scene = "gone.toml";
    result.problem = "gone.toml is not there.";
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
    EXPECT_EQ(shown().remedy, Shown::Remedy::defaultScene);
    whole = Document();
    EXPECT_EQ(shown().remedy, Shown::Remedy::back);
    // To a scene that has come to be broken there is no way back.
    whole->scene = "gone.toml";
    EXPECT_EQ(shown().remedy, Shown::Remedy::defaultScene);
    document.scene = Document().scene;
    whole.reset();
    EXPECT_EQ(shown().remedy, Shown::Remedy::none);
}

TEST_F(ShownTest, IsStaleWhereTheDeviceIsLostWhateverTheOrder) {
    result.isLost = true;
    result.problem = "Out of memory.";
    result.order = 0;
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
    EXPECT_EQ(shown().remedy, Shown::Remedy::restart);
}

TEST_F(ShownTest, IsStaleWhereTheTextureOrItsLayerIsMissing) {
    view.resource = "layers.depth";
    ViewedTexture& viewed = *result.variants[0].viewed;
    viewed.missing = ViewedTexture::Missing::texture;
    EXPECT_EQ(shown().remedy, Shown::Remedy::picture);
    EXPECT_TRUE(says("'layers.depth'"));
    viewed.missing = ViewedTexture::Missing::layer;
    viewed.layer = 6;
    viewed.layers = 4;
    EXPECT_EQ(shown().remedy, Shown::Remedy::layer);
    EXPECT_TRUE(says("no layer 6"));
    EXPECT_TRUE(says("0 to 3"));
    EXPECT_TRUE(isRendered(requested(), result)) << "it runs all the same";
}

TEST_F(ShownTest, IsStaleWhereShadersAreBroken) {
    result.shaderProblem = "a.frag:3: what is this?";
    EXPECT_EQ(shown().kind, Shown::Kind::stale);
    EXPECT_TRUE(says("a.frag:3"));
    EXPECT_NE(runObstacle(requested(), result), "");
}

TEST_F(ShownTest, SaysWhatIsMissingBesideThePicture) {
    view.comparedWith = ComparedImage::reference;
    ViewedTexture& viewed = *result.variants[0].viewed;
    viewed.name = "caustic.irradiance";
    viewed.content = contentOf(viewed.name, {});
    EXPECT_EQ(shown().kind, Shown::Kind::requested);
    EXPECT_TRUE(says("no reference of this view"));
    reference.photons = 1000;
    reference.irradiance = std::make_shared<const Image>();
    reference.aim = ReferenceAim{document.scene, document.edits, document.size, {}, 0};
    EXPECT_FALSE(says("no reference of this view"));
    reference.aim->size = {1, 1};
    EXPECT_TRUE(says("no reference of this view")) << "of another size";
    reference.aim->size = document.size;
    view.comparedWith = ComparedImage::error;
    EXPECT_TRUE(says("still being measured"));
    reference.judgements[0].order = kOrder;
    EXPECT_FALSE(says("still being measured"));
    EXPECT_TRUE(says("no pixel has an error")) << "where nothing is seen that is lit";
    reference.judgements[0].error = std::make_shared<const Image>();
    EXPECT_FALSE(says("error"));
    reference.judgements[0].order = kOrder - 1;
    EXPECT_TRUE(says("of a frame before"));
}

TEST_F(ShownTest, PassesThatAreNoLongerThereAreNotWhatWasAskedFor) {
    result.variants[0].absentPasses = {"shadow.lookup"};
    EXPECT_FALSE(isRendered(requested(), result)) << "the experiment would fail";
}

}  // namespace
}  // namespace kaustik::gui::test
