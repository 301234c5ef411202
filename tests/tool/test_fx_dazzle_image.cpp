// EXR pictures through the dazzle of the fx command: what is read, what is refused, what is changed.
#include "fxsdk/cli/dazzle/dazzle_apply.h"
#include "fxsdk/cli/dazzle/dazzle_image.h"
#include "rendering/exr/exr_encoder.h"
#include "tests/tool/temporary_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <numeric>

namespace fx::cli {
namespace {

constexpr int kWidth = 24, kHeight = 10;
constexpr size_t kPixels = size_t(kWidth) * kHeight;

std::vector<float> ramp(float scale)
{
    std::vector<float> values(kPixels);
    for (size_t i = 0; i < kPixels; ++i)
        values[i] = scale * float(i % 17) / 16.0f;
    return values;
}

class DazzleFile : public testing::Test
{
protected:
    std::string path(const char* name) const { return (folder_.path() / name).string(); }

    std::string written(const char* name, const std::map<std::string, std::vector<float>>& channels,
                        render::ExrPrecision precision = render::ExrPrecision::Float) const
    {
        render::ExrImage image;
        image.width = kWidth;
        image.height = kHeight;
        image.whiteLuminance = 123.0f;
        for (const auto& [channel, values] : channels)
            render::addPlane(image, channel, values, precision);
        std::ofstream(path(name), std::ios::binary) << *render::encodeExr(image);
        return path(name);
    }

    const DazzlePlane& plane(const DazzleImage& image, const std::string& name) const
    {
        for (const DazzlePlane& candidate : image.planes)
            if (candidate.name == name)
                return candidate;
        throw std::runtime_error("no channel " + name);
    }

    test::TemporaryFolder folder_;
};

const render::DazzleSettings kAll{.white = 1.0f, .a = 1.0f};

} // namespace

TEST_F(DazzleFile, isReadAsItWasWritten)
{
    const auto image = readDazzleImage(
        written("a.exr", {{"R", ramp(3)}, {"G", ramp(2)}, {"B", ramp(1)}, {"depth.Z", ramp(9)}}));
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_EQ(image->width, kWidth);
    EXPECT_EQ(image->height, kHeight);
    EXPECT_EQ(image->whiteLuminance, 123.0f);
    EXPECT_EQ(plane(*image, "G").values, ramp(2));
    EXPECT_EQ(plane(*image, "depth.Z").values, ramp(9));
    EXPECT_FALSE(plane(*image, "G").isHalf);
    const auto half = readDazzleImage(written("h.exr", {{"R", ramp(4)}}, render::ExrPrecision::Half));
    EXPECT_TRUE(plane(*half, "R").isHalf);
}

TEST_F(DazzleFile, lightIsChangedAndTheRestIsNot)
{
    auto image = *readDazzleImage(written(
        "a.exr", {{"R", ramp(3)}, {"G", ramp(2)}, {"B", ramp(1)}, {"A", ramp(1)}, {"fire.R", ramp(5)}}));
    const auto outcome = applyDazzle(image, DazzleAlgorithm::Exact, kAll);
    ASSERT_TRUE(outcome.ok());
    EXPECT_GT(outcome->overflow[0], outcome->overflow[1]);
    EXPECT_EQ(outcome->overflow[2], 0.0);
    EXPECT_EQ(plane(image, "A").values, ramp(1));
    EXPECT_EQ(plane(image, "fire.R").values, ramp(5));
    EXPECT_EQ(plane(image, "B").values, ramp(1));

    // the same numbers as the reference gives for the interleaved picture
    std::vector<float> rgba;
    for (size_t i = 0; i < kPixels; ++i)
        rgba.insert(rgba.end(), {ramp(3)[i], ramp(2)[i], ramp(1)[i], 1.0f});
    render::DazzleHistory history{};
    const auto want = render::dazzleReference(rgba, kWidth, kHeight, kAll, 0.0, true, history);
    for (size_t i = 0; i < kPixels; ++i)
        ASSERT_EQ(plane(image, "R").values[i], want[4 * i]);
}

TEST_F(DazzleFile, aGrayPictureWillDoAndOneWithoutLightWillNot)
{
    auto gray = *readDazzleImage(written("y.exr", {{"Y", ramp(3)}}));
    ASSERT_TRUE(applyDazzle(gray, DazzleAlgorithm::Exact, kAll).ok());
    EXPECT_GT(plane(gray, "Y").values[0], 0.0f);
    auto dark = *readDazzleImage(written("z.exr", {{"depth.Z", ramp(3)}}));
    EXPECT_EQ(applyDazzle(dark, DazzleAlgorithm::Exact, kAll).status().code(), base::Code::InvalidArgument);
}

TEST_F(DazzleFile, thePapersLevelsAreMultiplesOfA255thAndKeepTheirSum)
{
    auto image = *readDazzleImage(written("a.exr", {{"Y", ramp(1.5f)}}));
    ASSERT_TRUE(applyDazzle(image, DazzleAlgorithm::Paper8, kAll).ok());
    double sum = 0, before = 0;
    for (size_t i = 0; i < kPixels; ++i) {
        const double level = double(plane(image, "Y").values[i]) * 255.0;
        EXPECT_NEAR(level, std::round(level), 1e-4);
        sum += std::round(level);
        before += std::floor(double(ramp(1.5f)[i]) * 255.0 + 0.5);
    }
    EXPECT_EQ(sum, std::min(before, 255.0 * kPixels));
}

TEST_F(DazzleFile, tilesWindowsAndWholeNumbersAreUnderstood)
{
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}),
                       Imath::Box2i({-3, 5}, {-3 + kWidth - 1, 5 + kHeight - 1}));
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.setTileDescription({8, 8, Imf::ONE_LEVEL});
    std::vector<float> values = ramp(2);
    std::vector<unsigned> ids(kPixels, 7);
    Imf::FrameBuffer frame;
    frame.insert("R", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    frame.insert("id", Imf::Slice::Make(Imf::UINT, ids.data(), header.dataWindow()));
    {
        Imf::TiledOutputFile file(path("t.exr").c_str(), header);
        file.setFrameBuffer(frame);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    const auto image = readDazzleImage(path("t.exr"));
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_EQ(image->width, kWidth);
    EXPECT_EQ(image->planes.size(), 1u);
    EXPECT_EQ(plane(*image, "R").values, values);
    EXPECT_EQ(image->leftOut, std::vector<std::string>{"id"});
}

TEST_F(DazzleFile, picturesBeyondTheLimitsAreRefusedBeforeTheyAreRead)
{
    Imf::Header header(16385, 1);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    std::vector<float> row(16385);
    {
        Imf::FrameBuffer frame;
        frame.insert("R", Imf::Slice::Make(Imf::FLOAT, row.data(), header.dataWindow()));
        Imf::OutputFile file(path("wide.exr").c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(1);
    }
    EXPECT_EQ(readDazzleImage(path("wide.exr")).status().code(), base::Code::TooLarge);

    Imf::Header large(8192, 8192); // of which nothing was ever written
    large.channels().insert("R", Imf::Channel(Imf::FLOAT));
    large.compression() = Imf::NO_COMPRESSION;
    {
        Imf::OutputFile file(path("large.exr").c_str(), large);
    }
    EXPECT_EQ(readDazzleImage(path("large.exr")).status().code(), base::Code::TooLarge);
}

TEST_F(DazzleFile, anAttributeThatIsLongerThanTheFileIsRefusedBeforeMemoryIsTaken)
{
    const std::string whole = written("a.exr", {{"R", ramp(3)}});
    std::ifstream file(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string type("chromaticities\0chromaticities\0", 30);
    const size_t size = bytes.find(type) + type.size();
    ASSERT_EQ(bytes[size], 32); // eight floats
    bytes[size + 3] = 0x69;     // 1.7 GiB
    std::ofstream(path("long.exr"), std::ios::binary) << bytes;
    const auto image = readDazzleImage(path("long.exr"));
    EXPECT_EQ(int(image.status().code()), int(base::Code::Parse));
    EXPECT_NE(image.status().message().find("\"chromaticities\" says that it has 1761607712 bytes"),
              std::string::npos)
        << image.status().message();
}

TEST_F(DazzleFile, anAttributeThatIsNotAsLongAsItsTypeIsRefused)
{
    const std::string whole = written("a.exr", {{"R", ramp(3)}});
    std::ifstream file(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const std::string type("dataWindow\0box2i\0", 17); // 16 bytes are read, whatever the file says
    bytes[bytes.find(type) + type.size()] = 12;
    std::ofstream(path("short.exr"), std::ios::binary) << bytes;
    const auto image = readDazzleImage(path("short.exr"));
    EXPECT_EQ(int(image.status().code()), int(base::Code::Parse));
    EXPECT_NE(image.status().message().find("\"dataWindow\" of type \"box2i\" cannot have 12 bytes"),
              std::string::npos)
        << image.status().message();
}

TEST_F(DazzleFile, everyTruncationAndNonsenseIsRefusedAndNamesTheFile)
{
    const std::string whole = written("a.exr", {{"R", ramp(3)}});
    std::ifstream file(whole, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    for (size_t length = 0; length + 1 < bytes.size(); length += 7) {
        std::ofstream(path("cut.exr"), std::ios::binary) << bytes.substr(0, length);
        const auto image = readDazzleImage(path("cut.exr"));
        ASSERT_FALSE(image.ok()) << length;
        EXPECT_NE(image.status().message().find("cut.exr"), std::string::npos);
    }
    EXPECT_EQ(readDazzleImage(path("missing.exr")).status().code(), base::Code::Io);
}

TEST(DazzleSensor, isThreeNumbersThatMakeSense)
{
    render::DazzleSettings settings;
    ASSERT_TRUE(readSensor("0.5,0.25,2", settings).ok());
    EXPECT_EQ(settings.a, 0.5f);
    EXPECT_EQ(settings.b, 0.25f);
    EXPECT_EQ(settings.c, 2.0f);
    for (const char* text : {"", "1", "1,2", "1,2,3,4", "a,b,c", "1,0,1x", "nan,0,1", "0,1,1", "1,0,-1"}) {
        EXPECT_FALSE(readSensor(text, settings).ok()) << text;
        EXPECT_EQ(settings.a, 0.5f);
    }
}

} // namespace fx::cli
