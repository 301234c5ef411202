#include "fxsdk/editor/panels/curve_selection.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

const std::string kCurves = R"({"version": 1, "emitters": [{"name": "a",
    "sizeOverLife": {"keys": [[0, 0], [0.4, 1], [1, 2]]},
    "opacityOverLife": {"note": "mine", "keys": [[0, 10], [0.5, 30], [0.6, 40], [1, 10]]}}]})";
const std::string kSize = "/emitters/0/sizeOverLife", kOpacity = "/emitters/0/opacityOverLife";

class CurveSelection : public testing::Test
{
protected:
    CurveSelection()
    {
        auto opened = Document::fromText(kCurves, "a.fx.json");
        EXPECT_TRUE(opened.ok());
        document_ = std::make_unique<Document>(std::move(*opened));
        const Json& emitter = document_->json()["emitters"][0];
        curves_ = {{kSize, keysOf(emitter["sizeOverLife"]), 0.0, 2.0, 0.0, 5.0},
                   {kOpacity, keysOf(emitter["opacityOverLife"]), 0.0, 100.0, 0.0, 60.0}};
    }

    std::unique_ptr<Document> document_;
    std::vector<ShownCurve> curves_;
};

TEST_F(CurveSelection, keysOfSeveralCurvesMoveByTheSameTimeAndTheSameShareOfTheirScales)
{
    moveTogether(curves_, {{kSize, 1}, {kOpacity, 1}, {kOpacity, 2}}, 0.1, 0.25);
    EXPECT_EQ(curves_[0].keys, Json::parse("[[0, 0], [0.5, 1.5], [1, 2]]"));
    EXPECT_EQ(curves_[1].keys,
              Json::parse("[[0, 10], [0.6, 55.0], [0.7, 60.0], [1, 10]]")); // up to its limit
}

TEST_F(CurveSelection, noKeyPassesAnotherOneAndAllGoTheSameWay)
{
    moveTogether(curves_, {{kSize, 1}, {kOpacity, 1}}, 0.3, 0.0); // the opacity has room for 0.1 only
    EXPECT_NEAR(curves_[1].keys[1][0].get<double>(), 0.6 - 1e-4, 1e-9);
    EXPECT_NEAR(curves_[0].keys[1][0].get<double>(), 0.5 - 1e-4, 1e-9);
    moveTogether(curves_, {{kSize, 0}, {kOpacity, 1}}, -0.3, 0.0); // the size is at the beginning already
    EXPECT_NEAR(curves_[1].keys[1][0].get<double>(), 0.6 - 1e-4, 1e-9);
}

TEST_F(CurveSelection, valuesAreScaledWithinTheirLimitsAndColorsChannelByChannel)
{
    scaleTogether(curves_, {{kSize, 1}, {kOpacity, 2}}, 3.0);
    EXPECT_EQ(curves_[0].keys[1][1], 3.0);
    EXPECT_EQ(curves_[1].keys[2][1], 60.0);
    std::vector<ShownCurve> colors{{"/c", Json::parse("[[0, [1, 0.5, 0]]]"), 0.0, 1.0, 0.0, 10.0}};
    scaleTogether(colors, {{"/c", 0}}, 2.0);
    EXPECT_EQ(colors[0].keys[0][1], Json::parse("[2.0, 1.0, 0.0]"));
}

TEST_F(CurveSelection, severalCurvesAreOneEditThatKeepsTheirOtherMembers)
{
    const uint64_t gesture = 7;
    moveTogether(curves_, {{kSize, 1}}, 0.1, 0.0);
    ASSERT_TRUE(setCurves(*document_, curves_, gesture).ok());
    moveTogether(curves_, {{kSize, 1}, {kOpacity, 1}}, 0.05, 0.1);
    ASSERT_TRUE(setCurves(*document_, curves_, gesture).ok());
    EXPECT_EQ(document_->history().done(), 1u);
    const Json& emitter = document_->json()["emitters"][0];
    EXPECT_EQ(emitter["sizeOverLife"]["keys"], curves_[0].keys);
    EXPECT_EQ(emitter["opacityOverLife"]["keys"], curves_[1].keys);
    EXPECT_EQ(emitter["opacityOverLife"]["note"], "mine");
    ASSERT_TRUE(document_->undo());
    EXPECT_EQ(document_->text(), kCurves);
}

TEST_F(CurveSelection, whatHasNotChangedIsNoEdit)
{
    ASSERT_TRUE(setCurves(*document_, curves_, 0).ok());
    EXPECT_EQ(document_->history().done(), 0u);
    removeTogether(curves_, {{kOpacity, 1}, {kOpacity, 2}});
    ASSERT_TRUE(setCurves(*document_, curves_, 0).ok());
    EXPECT_EQ(document_->json()["emitters"][0]["opacityOverLife"]["keys"], Json::parse("[[0, 10], [1, 10]]"));
    EXPECT_EQ(document_->json()["emitters"][0]["sizeOverLife"]["keys"].size(), 3u);
}

} // namespace
} // namespace fx::editor
