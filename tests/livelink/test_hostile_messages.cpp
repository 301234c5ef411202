// What no client sends: the game answers with an error or closes the connection, and goes on.
#include "foundation/math/hash.h"
#include "tests/livelink/link_fixture.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace fx::test;
using namespace fx::link;

namespace {

/// A few thousand; FXSDK_HOSTILE_MESSAGES states another number.
uint64_t messageCount()
{
    const char* const given = std::getenv("FXSDK_HOSTILE_MESSAGES");
    return given ? std::strtoull(given, nullptr, 10) : 4000;
}

class Dice
{
public:
    explicit Dice(uint64_t seed) : state_(seed) {}
    uint64_t roll() { return state_ = fx::base::hashWord(state_, ++count_); }
    uint64_t below(uint64_t count) { return roll() % count; }
    std::string bytes(size_t count)
    {
        std::string text(count, '\0');
        for (char& c : text)
            c = char(roll());
        return text;
    }

private:
    uint64_t state_;
    uint64_t count_ = 0;
};

/// A valid message of some type.
std::string message(Dice& dice)
{
    switch (dice.below(5)) {
    case 0:
        return textOf(helloMessage(dice.below(2) == 0 ? "" : dice.bytes(dice.below(64))));
    case 1:
        return textOf({{"type", "list"}, {"id", dice.roll()}});
    case 2:
        return textOf(
            replaceMessage(dice.roll(), "edited fountain", fountainAt(double(dice.below(10))), false));
    case 3:
        return textOf(replaceMessage(1, dice.bytes(20), dice.bytes(dice.below(200)), true));
    default:
        return std::string(dice.below(200), '[');
    }
}

std::string damaged(Dice& dice, std::string text)
{
    for (uint64_t i = 0; i <= dice.below(4) && !text.empty(); ++i)
        switch (dice.below(4)) {
        case 0:
            text[dice.below(text.size())] = char(dice.roll());
            break;
        case 1:
            text.resize(dice.below(text.size()) + 1);
            break;
        case 2:
            text.erase(dice.below(text.size()), dice.below(8));
            break;
        default:
            text.insert(dice.below(text.size()), dice.bytes(dice.below(8)));
        }
    return text;
}

std::string hostile(Dice& dice)
{
    const std::string text = message(dice);
    std::string frame = frameOf(text);
    switch (dice.below(6)) {
    case 0:
        return dice.bytes(1 + dice.below(300)); // garbage
    case 1:
        return frame.substr(0, dice.below(frame.size())); // truncated
    case 2:
        frame[2 + dice.below(2)] = char(dice.roll()); // another length
        return frame;
    case 3:
        return frameOf(damaged(dice, text));
    case 4:
        return frameOf("") + frame;
    default:
        return frame + frame.substr(0, dice.below(frame.size()));
    }
}

} // namespace

TEST_F(LinkTest, hostileMessagesEndNothingButTheirConnection)
{
    open([](FxLiveLinkDef& def) {
        def.flags = FX_LIVELINK_LOAD_ON_UPDATE;
        def.maxMessageBytes = 1u << 16;
    });
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = edited_;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    const std::string hello = frameOf(textOf(helloMessage("")));
    Dice dice(1);
    const uint64_t count = messageCount();
    uint64_t closed = 0, answered = 0;
    for (uint64_t i = 0; i < count; ++i) {
        auto socket = Socket::connect(address());
        ASSERT_TRUE(socket.ok()) << i << ": " << socket.status().message();
        const std::string sent = (dice.below(3) == 0 ? "" : hello) + hostile(dice);
        const size_t portion = dice.below(8) == 0 ? 1 : std::max<size_t>(sent.size(), 1);
        bool isOpen = true, hasAnswer = false;
        for (size_t at = 0; at <= sent.size() && isOpen; at += portion) {
            if (at < sent.size())
                isOpen = socket->send(std::string_view(sent).substr(at, portion)).ok();
            ASSERT_EQ(fxLiveLink_Update(link_, &scene_, 1), FX_OK) << fxGetLiveLinkErrorMessage();
        }
        char bytes[8192];
        for (auto got = socket->receive(bytes, sizeof bytes); got.ok() && *got > 0 && isOpen;
             got = socket->receive(bytes, sizeof bytes))
            hasAnswer = true;
        isOpen = isOpen && socket->receive(bytes, 1).ok();
        closed += isOpen ? 0 : 1;
        answered += hasAnswer ? 1 : 0;
        *socket = Socket();
        ASSERT_EQ(fxLiveLink_Update(link_, &scene_, 1), FX_OK);
    }
    std::printf("%llu hostile messages: %llu connections closed by the game, %llu answered\n",
                static_cast<unsigned long long>(count), static_cast<unsigned long long>(closed),
                static_cast<unsigned long long>(answered));
    EXPECT_GT(closed, count / 10);
    EXPECT_GT(answered, count / 3);
    EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
    auto client = greeted(); // the game serves the next one
    ASSERT_TRUE(client->send(replaceMessage(1, kFountainFile, fountainAt(30), false)).ok());
    EXPECT_EQ(reply(*client)["type"], "replaced");
    play(60);
    EXPECT_NEAR(meanHeight(), 30.0, 0.5);
    uint32_t presets = 0;
    EXPECT_EQ(fxGetPresets(context_, nullptr, 0, &presets), FX_OK);
    EXPECT_EQ(presets, 2u); // nothing is left behind
}

TEST_F(LinkTest, aSilentClientLosesItsPlace)
{
    open();
    auto silent = Socket::connect(address());
    ASSERT_TRUE(silent.ok());
    frame();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    char bytes[1024];
    bool isClosed = false;
    while (!isClosed && std::chrono::steady_clock::now() < end) {
        frame(0.0);
        isClosed = !silent->receive(bytes, sizeof bytes).ok();
        silent->wait(0.05, false);
    }
    EXPECT_TRUE(isClosed);
    EXPECT_EQ(linkStatistics().refused, 1u);
    (void)greeted();
}
