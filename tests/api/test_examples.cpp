// The examples run, and what they draw is an effect.
#include "rendering/image/image.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace {

/// Largest difference of any pixel from the first: how far the picture is from empty.
float contrastOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const auto image = fx::image::readPng({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
    EXPECT_TRUE(image.ok()) << image.status().message();
    if (!image)
        return 0.0f;
    float contrast = 0.0f;
    for (size_t i = 0; i < image->pixels.size(); ++i)
        contrast =
            std::max(contrast, std::abs(image->pixels[i] - image->pixels[i % size_t(image->channels)]));
    return contrast;
}

int run(const std::string& command)
{
    return std::system(command.c_str());
}

} // namespace

TEST(Examples, helloDrawsAnExplosionWithoutAWindow)
{
    const fx::test::TemporaryFolder folder;
    const std::string output = (folder / "hello.png").string();
    ASSERT_EQ(run(std::string(FX_HELLO) + " --headless --frames 3 --output " + output), 0);
    EXPECT_GT(contrastOf(output), 0.2f);
    EXPECT_NE(run(std::string(FX_HELLO) + " --headless --frames 1 --output /nowhere/hello.png 2> /dev/null"),
              0);
}

TEST(Examples, aPresetIsRenderedToAFile)
{
    const fx::test::TemporaryFolder folder;
    const std::string output = (folder / "file.png").string();
    ASSERT_EQ(run(std::string(FX_RENDER_TO_FILE) + " smoke-column 3 " + output), 0);
    EXPECT_GT(contrastOf(output), 0.05f);
    EXPECT_NE(run(std::string(FX_RENDER_TO_FILE) + " volcano 1 " + output + " 2> /dev/null"), 0);
}

TEST(Examples, smokeDarkensTheGroundOfAGame)
{
    const fx::test::TemporaryFolder folder;
    const std::string output = (folder / "shadow.png").string();
    ASSERT_EQ(run(std::string(FX_MEDIA_SHADOW) + " smoke-column 3 " + output), 0);
    EXPECT_GT(contrastOf(output), 0.05f);
    EXPECT_NE(run(std::string(FX_MEDIA_SHADOW) + " volcano 1 " + output + " 2> /dev/null"), 0);
}

TEST(Examples, theFirstEffectTakesAtMostTwentyFiveLines)
{
    std::ifstream file(std::string(FX_SOURCE_DIR) + "/examples/00_hello/main.c");
    int lines = 0;
    bool isInside = false;
    for (std::string line; std::getline(file, line);) {
        isInside = isInside || line == "{";
        if (line == "}")
            break;
        lines += isInside && line != "{" ? 1 : 0;
    }
    EXPECT_GT(lines, 10);
    EXPECT_LE(lines, 25);
}
