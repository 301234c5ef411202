/// What fx render writes into EXR files, read back with OpenEXR itself.

#include "tests/tool/temporary_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

namespace fx::cli {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;
constexpr size_t kPixels = size_t(kWidth) * kHeight;

using Channels = std::map<std::string, std::vector<float>>;

Channels readAll(const std::filesystem::path& path)
{
    Imf::InputFile file(path.c_str());
    Channels channels;
    Imf::FrameBuffer frame;
    for (auto i = file.header().channels().begin(); i != file.header().channels().end(); ++i) {
        std::vector<float>& values = channels.emplace(i.name(), kPixels).first->second;
        frame.insert(i.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                          sizeof(float) * kWidth));
    }
    file.setFrameBuffer(frame);
    file.readPixels(0, kHeight - 1);
    return channels;
}

/// An explosion on its default stage, in the composition whose layers add up exactly.
class FxExr : public ::testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        test::TemporaryFolder folder;
        const std::string command =
            std::string(FX_BINARY_DIR
                        "/bin/fx render library:explosion --composition sorted --time 0.6 --size ") +
            std::to_string(kWidth) + "x" + std::to_string(kHeight) + " -o " + (folder / "a.exr").string() +
            " > /dev/null";
        ASSERT_EQ(std::system(command.c_str()), 0);
        channels = new Channels(readAll(folder / "a.exr"));
    }
    static void TearDownTestSuite() { delete channels; }

    static const std::vector<float>& channel(const std::string& name) { return channels->at(name); }

    inline static Channels* channels = nullptr;
};

TEST_F(FxExr, everyPromisedChannelIsThere)
{
    for (const char* name : {"R", "G", "B", "A", "depth.Z", "opticalDepth.Y"})
        EXPECT_EQ(channels->count(name), 1u) << name;
    for (const char* layer : {"fire", "smoke", "dust", "background"}) {
        for (const char* name : {".R", ".G", ".B", ".A"})
            EXPECT_EQ(channels->count(std::string(layer) + name), 1u) << layer << name;
    }
}

TEST_F(FxExr, theLayersOverTheBackgroundAreTheBeauty)
{
    double covered = 0.0;
    for (const char* color : {".R", ".G", ".B"}) {
        const std::vector<float>& beauty = channel(std::string(1, color[1]));
        for (size_t i = 0; i < kPixels; ++i) {
            double sum = 0.0;
            double alpha = 0.0;
            for (const std::string layer : {"fire", "smoke", "dust"}) {
                sum += double(channel(layer + color)[i]);
                alpha += double(channel(layer + ".A")[i]);
            }
            const double expected =
                sum + (1.0 - alpha) * double(channel(std::string("background") + color)[i]);
            EXPECT_NEAR(double(beauty[i]), expected, 1e-3 * std::max(std::abs(expected), 1e-3))
                << "pixel " << i;
            covered += alpha;
        }
    }
    EXPECT_GT(covered / (3.0 * kPixels), 0.05); // otherwise there was nothing to add up
}

TEST_F(FxExr, everyLayerIsFiniteAndItsShareLiesBetweenNothingAndAll)
{
    for (const std::string layer : {"fire", "smoke", "dust"}) {
        for (const float share : channel(layer + ".A")) {
            EXPECT_GE(share, 0.0f);
            EXPECT_LE(share, 1.0f);
        }
        for (const char* color : {".R", ".G", ".B"}) {
            for (const float value : channel(layer + color))
                EXPECT_TRUE(std::isfinite(value) && value >= 0.0f) << layer << color;
        }
    }
}

TEST_F(FxExr, depthIsFiniteExactlyWhereThereIsMedium)
{
    for (size_t i = 0; i < kPixels; ++i) {
        const float opticalDepth = channel("opticalDepth.Y")[i];
        const float depth = channel("depth.Z")[i];
        EXPECT_GE(opticalDepth, 0.0f);
        EXPECT_EQ(std::isfinite(depth), opticalDepth > 0.0f) << "pixel " << i << " depth " << depth;
        EXPECT_GT(depth, 0.0f);
    }
}

TEST_F(FxExr, rowsBeginAtTheTop)
{
    // The sky is the background of the first row and the ground that of the last; the sky is bluer.
    const size_t top = kWidth / 2;
    const size_t bottom = kPixels - kWidth / 2;
    const auto blueness = [](size_t i) { return channel("background.B")[i] / channel("background.R")[i]; };
    EXPECT_GT(blueness(top), blueness(bottom));
}

} // namespace
} // namespace fx::cli
