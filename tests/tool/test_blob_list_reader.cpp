/// Lists of blobs: what is read, and messages that say where a list is wrong.

#include "fxsdk/cli/render/blob_list_reader.h"

#include <gtest/gtest.h>

#include <string>

namespace fx::cli {
namespace {

const std::string kHeader = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb\n";

std::string messageOf(const std::string& rows, bool withHeader = true)
{
    const auto blobs = readBlobList((withHeader ? kHeader : "") + rows, "a.blobs.csv");
    EXPECT_FALSE(blobs.ok());
    EXPECT_EQ(blobs.status().code(), base::Code::Parse);
    return blobs.status().message();
}

bool startsWith(const std::string& text, const std::string& start)
{
    return text.compare(0, start.size(), start) == 0;
}

TEST(BlobListReader, readsNineNumbersALineAndEmitsByWhatIsNotScattered)
{
    const auto blobs =
        readBlobList(kHeader + "1,-2.5,3e2,0.5,0.25,0.75,4,8,16\n0,0,0,1,0,0,0,0,0\n", "a.blobs.csv");
    ASSERT_TRUE(blobs.ok()) << blobs.status().message();
    ASSERT_EQ(blobs->size(), 2u);
    const render::MediumBlob& blob = blobs->front();
    EXPECT_EQ(blob.center, glm::dvec3(1.0, -2.5, 300.0));
    EXPECT_EQ(blob.radius, 0.5);
    EXPECT_EQ(blob.crossSection, 0.25);
    EXPECT_EQ(blob.albedo, glm::dvec3(0.75));
    EXPECT_EQ(blob.source, glm::dvec3(1.0, 2.0, 4.0));
}

TEST(BlobListReader, acceptsWindowsLineEndsSpacesEmptyLinesAndAMissingLastLineEnd)
{
    const auto blobs = readBlobList("x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb\r\n"
                                    " 1 , 2,3 ,1,1,0,1,1,1\r\n\r\n1,2,3,1,1,0,1,1,1",
                                    "a.blobs.csv");
    ASSERT_TRUE(blobs.ok()) << blobs.status().message();
    EXPECT_EQ(blobs->size(), 2u);
    EXPECT_TRUE(readBlobList(kHeader, "a.blobs.csv")->empty());
}

TEST(BlobListReader, theByteOrderMarkOfASpreadsheetIsNoFault)
{
    EXPECT_EQ(readBlobList("\xEF\xBB\xBF" + kHeader + "1,2,3,1,1,0,1,1,1\n", "a.blobs.csv")->size(), 1u);
}

TEST(BlobListReader, messagesShowTheRangeAndNoControlCharacters)
{
    EXPECT_NE(messageOf("1,2,3,1,1e400,0,1,1,1\n").find("expected a number from 0 to 1e12"),
              std::string::npos);
    EXPECT_NE(messageOf("\x1b[31mred,2,3,1,1,0,1,1,1\n").find("found '?[31mred' for x"), std::string::npos);
}

TEST(BlobListReader, anotherHeaderIsRefusedAndTheRightOneIsShown)
{
    for (const char* text : {"", "\n", "x,y,z,radius,tau_area,albedo,er,eg,eb\n", "1,2,3,1,1,0,1,1,1\n"}) {
        const std::string message = messageOf(text, false);
        EXPECT_TRUE(startsWith(message, "a.blobs.csv:1:1: ")) << message;
        EXPECT_NE(message.find("tau_area[m2]"), std::string::npos);
    }
}

TEST(BlobListReader, messagesNameFileLineAndColumn)
{
    const std::string good = "1,2,3,1,1,0,1,1,1\n";
    EXPECT_TRUE(startsWith(messageOf(good + "1,2,x,1,1,0,1,1,1\n"), "a.blobs.csv:3:5: found 'x' for z"));
    EXPECT_TRUE(startsWith(messageOf("1,2,3,1,1,0,1,1\n"), "a.blobs.csv:2:16: expected 9 numbers, found 8"));
    EXPECT_TRUE(startsWith(messageOf("1,2,3,1,1,0,1,1,1,5\n"), "a.blobs.csv:2:18: expected the end"));
    EXPECT_TRUE(startsWith(messageOf("1,2,3,1,1,0,1,1,\n"), "a.blobs.csv:2:17: found '' for eb"));
}

TEST(BlobListReader, aTenthColumnIsTheMeanCosine)
{
    const std::string header = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb,g\n";
    const auto blobs = readBlobList(header + "1,2,3,1,1,0,1,1,1,-0.4\n", "a.blobs.csv");
    ASSERT_TRUE(blobs.ok());
    EXPECT_EQ(blobs->front().anisotropy, -0.4);
    EXPECT_TRUE(startsWith(messageOf(header + "1,2,3,1,1,0,1,1,1\n", false),
                           "a.blobs.csv:2:18: expected 10 numbers, found 9"));
    EXPECT_TRUE(
        startsWith(messageOf(header + "1,2,3,1,1,0,1,1,1,1\n", false), "a.blobs.csv:2:19: found '1' for g"));
}

TEST(BlobListReader, numbersOutsideTheirRangeAreRefused)
{
    for (const char* row :
         {"nan,2,3,1,1,0,1,1,1", "inf,2,3,1,1,0,1,1,1", "1e13,2,3,1,1,0,1,1,1", "1e400,2,3,1,1,0,1,1,1",
          "1,2,3,0,1,0,1,1,1", "1,2,3,-1,1,0,1,1,1", "1,2,3,1,-1,0,1,1,1", "1,2,3,1,1,1.5,1,1,1",
          "1,2,3,1,1,0,-1,1,1", "1,2,3,1,1,0,1,1,1x", "0x1,2,3,1,1,0,1,1,1", "1 2,2,3,1,1,0,1,1,1"})
        EXPECT_TRUE(startsWith(messageOf(row), "a.blobs.csv:2:")) << row;
}

TEST(BlobListReader, everyTruncationIsReadOrRefusedCleanly)
{
    const std::string text = kHeader + "1,-2.5,3e2,0.5,0.25,0.75,4,8,16\n1,-2.5,3e2,0.5,0.25,0.75,4,8,16\n";
    for (size_t length = 0; length < text.size(); ++length) {
        const auto blobs = readBlobList(text.substr(0, length), "a.blobs.csv");
        EXPECT_TRUE(blobs.ok() || blobs.status().code() == base::Code::Parse);
    }
}

TEST(BlobListReader, aMissingFileIsNamed)
{
    const auto blobs = loadBlobList("/nowhere/a.blobs.csv");
    EXPECT_EQ(blobs.status().code(), base::Code::NotFound);
    EXPECT_NE(blobs.status().message().find("/nowhere/a.blobs.csv"), std::string::npos);
}

} // namespace
} // namespace fx::cli
