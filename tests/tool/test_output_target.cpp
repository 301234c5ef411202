#include "fxsdk/cli/support/output_target.h"

#include <gtest/gtest.h>

namespace fx::cli {
namespace {

TEST(OutputTarget, theSuffixDecidesTheKindWhateverItsCase)
{
    EXPECT_EQ(parseOutputTarget("a.png")->kind, OutputKind::Png);
    EXPECT_EQ(parseOutputTarget("a.EXR")->kind, OutputKind::Exr);
    EXPECT_EQ(parseOutputTarget("folder/a.mp4")->kind, OutputKind::Mp4);
}

TEST(OutputTarget, anythingElseIsRefusedWithTheChoices)
{
    for (const char* text : {"", "a", "a.jpg", "png", "folder/"}) {
        const auto target = parseOutputTarget(text);
        ASSERT_FALSE(target.ok()) << text;
        EXPECT_NE(target.status().message().find(".exr"), std::string::npos);
    }
}

TEST(OutputTarget, aPlaceHolderMakesASequenceWithThatManyDigits)
{
    const auto target = parseOutputTarget("out/a.%04d.exr");
    ASSERT_TRUE(target.ok());
    EXPECT_TRUE(target->isSequence());
    EXPECT_EQ(target->frame(7), "out/a.0007.exr");
    EXPECT_EQ(target->frame(12345), "out/a.12345.exr");
    EXPECT_EQ(parseOutputTarget("a%d.png")->frame(0), "a0.png");
}

TEST(NumberedFile, anySuffixMayHaveAPlaceHolder)
{
    const auto file = parseNumberedFile("out/a.%03d.vdb");
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->frame(7), "out/a.007.vdb");
    EXPECT_FALSE(parseNumberedFile("a.vdb")->isSequence());
    EXPECT_FALSE(parseNumberedFile("a%d%d.vdb").ok());
    EXPECT_EQ(suffixOf("folder.x/A.VDB"), ".vdb");
}

TEST(OutputTarget, aStillHasOneFileForEveryNumber)
{
    const auto target = parseOutputTarget("a.png");
    EXPECT_TRUE(target->isStill());
    EXPECT_EQ(target->frame(3), "a.png");
}

TEST(OutputTarget, otherUsesOfThePercentSignAreRefused)
{
    for (const char* text : {"a%d%d.png", "a%s.png", "a%.png", "a%%.png", "%d/a.png", "a%04d.mp4", "a%n.exr"})
        EXPECT_FALSE(parseOutputTarget(text).ok()) << text;
}

} // namespace
} // namespace fx::cli
