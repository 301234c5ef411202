#include "rendering/exr/exr_encoder.h"
#include "tests/tool/temporary_folder.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace fx::render {
namespace {

constexpr int kWidth = 5;
constexpr int kHeight = 3;
constexpr size_t kPixels = size_t(kWidth) * kHeight;

/// RGBA whose every value is different and not a half.
std::vector<float> testPicture()
{
    std::vector<float> rgba(kPixels * 4);
    for (size_t i = 0; i < rgba.size(); ++i)
        rgba[i] = 0.1f + 1.7f * float(i);
    return rgba;
}

/// Reads one channel with OpenEXR itself, rows from the top.
std::vector<float> readChannel(const std::string& bytes, const std::string& name)
{
    test::TemporaryFolder folder;
    test::writeText(folder / "a.exr", bytes);
    Imf::InputFile file((folder / "a.exr").c_str());
    std::vector<float> values(kPixels, -1.0f);
    Imf::FrameBuffer frame;
    frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                  sizeof(float) * kWidth));
    file.setFrameBuffer(frame);
    file.readPixels(0, kHeight - 1);
    return values;
}

TEST(ExrEncoder, floatChannelsComeBackBitForBitInTheirPlaces)
{
    const std::vector<float> rgba = testPicture();
    ExrImage image{kWidth, kHeight, {}, 0.0f};
    addRgba(image, "", rgba, ExrPrecision::Float);
    const auto bytes = encodeExr(image);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const char* const names[] = {"R", "G", "B", "A"};
    for (size_t c = 0; c < 4; ++c) {
        const std::vector<float> read = readChannel(*bytes, names[c]);
        for (size_t i = 0; i < kPixels; ++i)
            EXPECT_EQ(read[i], rgba[i * 4 + c]) << names[c] << " pixel " << i;
    }
}

TEST(ExrEncoder, theBytesDoNotDependOnTheNumberOfThreads)
{
    constexpr int kSide = 300; // 19 blocks of 16 rows
    std::vector<float> rgba(size_t(kSide) * kSide * 4);
    for (size_t i = 0; i < rgba.size(); ++i)
        rgba[i] = std::sin(0.001f * float(i)) * float(i % 7);
    ExrImage image{kSide, kSide, {}, 0.0f};
    addRgba(image, "", rgba, ExrPrecision::Float);
    addRgba(image, "smoke", rgba, ExrPrecision::Half);
    const auto one = encodeExr(image, 1);
    ASSERT_TRUE(one.ok()) << one.status().message();
    for (const uint32_t threads : {2u, 3u, 8u, 0u, 1u})
        EXPECT_TRUE(*encodeExr(image, threads) == *one) << threads;
}

TEST(ExrEncoder, asManyThreadsWorkAsAreAskedFor)
{
    const std::vector<float> rgba = testPicture();
    ExrImage image{kWidth, kHeight, {}, 0.0f};
    addRgba(image, "", rgba, ExrPrecision::Float);
    ASSERT_TRUE(encodeExr(image, 3).ok());
    EXPECT_GE(Imf::globalThreadCount(), 3);
    ASSERT_TRUE(encodeExr(image).ok()); // all of the machine
    EXPECT_GE(Imf::globalThreadCount(), int(std::thread::hardware_concurrency()));
}

TEST(ExrEncoder, halfChannelsAreWithinTheStatedRelativeError)
{
    const std::vector<float> rgba = testPicture();
    ExrImage image{kWidth, kHeight, {}, 0.0f};
    addRgba(image, "fire", rgba, ExrPrecision::Half);
    const std::vector<float> read = readChannel(*encodeExr(image, 2), "fire.B");
    bool exact = true;
    for (size_t i = 0; i < kPixels; ++i) {
        EXPECT_NEAR(read[i], rgba[i * 4 + 2], std::ldexp(rgba[i * 4 + 2], -11));
        exact = exact && read[i] == rgba[i * 4 + 2];
    }
    EXPECT_FALSE(exact); // otherwise the channel was not a half
}

TEST(ExrEncoder, wholeChannelsAreWholeNumbersInTheFileToo)
{
    ExrImage image{kWidth, kHeight, {}};
    const float given[] = {
        0.0f, 1.0f, 16777216.0f, 2.6f, -3.0f, 4e9f, std::numeric_limits<float>::quiet_NaN()};
    std::vector<float> values(kPixels, 7.0f);
    std::copy(std::begin(given), std::end(given), values.begin());
    addPlane(image, "id", values, ExrPrecision::Whole);
    const auto bytes = encodeExr(image);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    test::TemporaryFolder folder;
    test::writeText(folder / "a.exr", *bytes);
    Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().channels()["id"].type, Imf::UINT);
    std::vector<uint32_t> read(kPixels, 99);
    Imf::FrameBuffer frame;
    frame.insert("id", Imf::Slice(Imf::UINT, reinterpret_cast<char*>(read.data()), sizeof(uint32_t),
                                  sizeof(uint32_t) * kWidth));
    file.setFrameBuffer(frame);
    file.readPixels(0, kHeight - 1);
    const uint32_t expected[] = {0, 1, 16777216, 3, 0, 16777216, 0, 7};
    EXPECT_TRUE(std::equal(std::begin(expected), std::end(expected), read.begin()));
}

TEST(ExrEncoder, finiteValuesBeyondHalfStayFiniteAndInfinityStaysInfinite)
{
    std::vector<float> values(kPixels, 0.0f);
    values[0] = 1e9f;
    values[1] = -1e9f;
    values[2] = std::numeric_limits<float>::infinity();
    ExrImage image{kWidth, kHeight, {}, 0.0f};
    addPlane(image, "opticalDepth.Y", values, ExrPrecision::Half);
    const std::vector<float> read = readChannel(*encodeExr(image), "opticalDepth.Y");
    EXPECT_EQ(read[0], 65504.0f);
    EXPECT_EQ(read[1], -65504.0f);
    EXPECT_TRUE(std::isinf(read[2]));
}

TEST(ExrEncoder, layersStandBesideEachOtherUnderTheirNames)
{
    const std::vector<float> rgba = testPicture();
    const std::vector<float> depth(kPixels, 12.5f);
    ExrImage image{kWidth, kHeight, {}, 9830.4f};
    addRgba(image, "", rgba, ExrPrecision::Float);
    addRgba(image, "smoke", rgba, ExrPrecision::Half);
    addPlane(image, "depth.Z", depth, ExrPrecision::Float);
    const auto bytes = encodeExr(image);
    ASSERT_TRUE(bytes.ok());
    test::TemporaryFolder folder;
    test::writeText(folder / "a.exr", *bytes);
    Imf::InputFile file((folder / "a.exr").c_str());
    std::vector<std::string> names;
    for (auto i = file.header().channels().begin(); i != file.header().channels().end(); ++i)
        names.push_back(i.name());
    EXPECT_EQ(names, (std::vector<std::string>{"A", "B", "G", "R", "depth.Z", "smoke.A", "smoke.B", "smoke.G",
                                               "smoke.R"}));
    EXPECT_EQ(Imf::whiteLuminance(file.header()), 9830.4f);
    EXPECT_EQ(readChannel(*bytes, "depth.Z"), depth);
}

TEST(ExrEncoder, whatCannotBeAnImageIsRefusedByName)
{
    const std::vector<float> values(kPixels, 0.0f);
    ExrImage none{kWidth, kHeight, {}, 0.0f};
    EXPECT_EQ(encodeExr(none).status().code(), base::Code::InvalidArgument);

    ExrImage empty{0, kHeight, {}, 0.0f};
    addPlane(empty, "Y", values, ExrPrecision::Float);
    EXPECT_EQ(encodeExr(empty).status().code(), base::Code::InvalidArgument);

    ExrImage twice{kWidth, kHeight, {}, 0.0f};
    addPlane(twice, "Y", values, ExrPrecision::Float);
    addPlane(twice, "Y", values, ExrPrecision::Float);
    EXPECT_NE(encodeExr(twice).status().message().find("Y"), std::string::npos);

    ExrImage tooShort{kWidth, kHeight + 1, {}, 0.0f};
    addPlane(tooShort, "depth.Z", values, ExrPrecision::Float);
    EXPECT_NE(encodeExr(tooShort).status().message().find("depth.Z"), std::string::npos);
}

} // namespace
} // namespace fx::render
