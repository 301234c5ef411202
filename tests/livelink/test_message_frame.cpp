#include "fxsdk/livelink/protocol/message_frame.h"

#include <gtest/gtest.h>

#include <string>

using fx::base::Code;
using fx::link::frameOf;
using fx::link::FrameReader;

namespace {

std::string lengthOf(uint32_t size)
{
    return {char(size & 0xFF), char((size >> 8) & 0xFF), char((size >> 16) & 0xFF), char(size >> 24)};
}

} // namespace

TEST(MessageFrame, hasALittleEndianLengthBeforeTheText)
{
    EXPECT_EQ(frameOf("abc"), lengthOf(3) + "abc");
    EXPECT_EQ(frameOf(std::string(300, 'x')), std::string("\x2c\x01\0\0", 4) + std::string(300, 'x'));
}

TEST(FrameReader, assemblesMessagesFromPortionsOfAnySize)
{
    const std::string sent = frameOf("first") + frameOf("2") + frameOf(std::string(5000, 'z'));
    for (const size_t portion : {size_t(1), size_t(3), size_t(4), size_t(7), size_t(4096), sent.size()}) {
        FrameReader reader(6000);
        std::string joined;
        int count = 0;
        for (size_t at = 0; at < sent.size(); at += portion) {
            reader.add(std::string_view(sent).substr(at, portion));
            for (auto message = reader.take(); message.ok() && *message; message = reader.take(), ++count)
                joined += **message + "|";
        }
        EXPECT_EQ(count, 3) << portion;
        EXPECT_EQ(joined, "first|2|" + std::string(5000, 'z') + "|");
        EXPECT_FALSE(reader.isInMessage());
    }
}

TEST(FrameReader, refusesLengthsThatAreNotAllowedBeforeTheTextArrives)
{
    FrameReader reader(100);
    reader.add(lengthOf(101));
    EXPECT_EQ(reader.take().status().code(), Code::TooLarge);
    FrameReader other(100);
    other.add(lengthOf(0xFFFFFFFFu));
    EXPECT_EQ(other.take().status().code(), Code::TooLarge);
    FrameReader empty(100);
    empty.add(lengthOf(0));
    EXPECT_EQ(empty.take().status().code(), Code::InvalidArgument);
    FrameReader longest(100);
    longest.add(frameOf(std::string(100, 'a')));
    const auto message = longest.take();
    ASSERT_TRUE(message.ok() && *message);
    EXPECT_EQ((*message)->size(), 100u);
}

TEST(FrameReader, waitsForTheRestOfAMessage)
{
    FrameReader reader(100);
    EXPECT_FALSE(reader.isInMessage());
    reader.add(lengthOf(5) + "abcd");
    const auto message = reader.take();
    ASSERT_TRUE(message.ok());
    EXPECT_FALSE(message->has_value());
    EXPECT_TRUE(reader.isInMessage());
    EXPECT_EQ(reader.bytes(), 8u);
}
