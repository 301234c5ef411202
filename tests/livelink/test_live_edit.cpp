// The editor's end: the newest text wins, and a lost connection is made again.
#include "fxsdk/livelink/client/live_edit.h"
#include "tests/livelink/link_fixture.h"

#include <chrono>
#include <thread>

using namespace fx::test;
using namespace fx::link;

namespace {

class LiveEditTest : public LinkTest
{
protected:
    /// Frames of game and editor until a condition holds.
    template <class F>
    void playUntil(LiveEdit& edit, F&& holds)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (!holds()) {
            ASSERT_LT(std::chrono::steady_clock::now(), end);
            edit.update(kFrame);
            if (link_)
                frame();
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    }
    void addEdited()
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = edited_;
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    }
};

} // namespace

TEST_F(LiveEditTest, theGameShowsTheNewestText)
{
    open();
    addEdited();
    LiveEdit edit;
    edit.start(address(), "", kFountainFile);
    for (uint64_t revision = 1; revision <= 20; ++revision) { // faster than the game answers
        edit.offer(fountainAt(double(revision)), revision);
        edit.update(0.001);
    }
    playUntil(edit, [&] { return edit.outcome().revision == 20; });
    EXPECT_TRUE(edit.outcome().isShown);
    EXPECT_EQ(edit.outcome().instances, 1u);
    EXPECT_LT(linkStatistics().replacements, 20u); // those in between were not sent
    play(30);
    EXPECT_NEAR(meanHeight(), 20.0, 0.5);
    playUntil(edit, [&] { return !edit.list().is_null(); });
    EXPECT_EQ(edit.list()["instanceCount"], 1);
    EXPECT_EQ(edit.game(), "test-game");
}

TEST_F(LiveEditTest, findingsOfTheGameAreReported)
{
    open();
    LiveEdit edit;
    edit.start(address(), "", kFountainFile);
    edit.offer("{\"version\": 1,", 1);
    playUntil(edit, [&] { return edit.outcome().revision == 1; });
    EXPECT_FALSE(edit.outcome().isShown);
    EXPECT_NE(edit.outcome().message.find("fountain.fx.json:1"), std::string::npos) << edit.outcome().message;
    edit.offer(fountainAt(2), 2);
    playUntil(edit, [&] { return edit.outcome().revision == 2; });
    EXPECT_TRUE(edit.outcome().isShown);
}

TEST_F(LiveEditTest, aGameThatStartsAgainGetsTheLastText)
{
    LiveEdit edit;
    edit.start({socketPath_, 0}, "", kFountainFile);
    edit.offer(fountainAt(5), 1);
    edit.update(kFrame);
    EXPECT_EQ(edit.state(), LinkState::Connecting);
    EXPECT_FALSE(edit.message().empty());
    open();
    playUntil(edit, [&] { return edit.outcome().revision == 1; });
    EXPECT_TRUE(edit.message().empty());
    fxDestroyLiveLink(link_);
    link_ = nullptr;
    playUntil(edit, [&] { return edit.state() == LinkState::Connecting; });
    EXPECT_FALSE(edit.message().empty());
    const std::string original = fountainAt(1);
    addEdited();
    open();
    playUntil(edit, [&] { return edit.connections() == 2 && !edit.isBusy(); });
    EXPECT_EQ(linkStatistics().replacements, 1u); // of the new link
    edit.stop();
    EXPECT_EQ(edit.state(), LinkState::Off);
    frame();
    EXPECT_EQ(linkStatistics().hasClient, 0u);
}

TEST_F(LiveEditTest, aBusyGameIsTriedAgain)
{
    open();
    auto other = greeted();
    LiveEdit edit;
    edit.start(address(), "", kFountainFile);
    playUntil(edit, [&] { return edit.message().find("another client") != std::string::npos; });
    other.reset();
    playUntil(edit, [&] { return edit.state() == LinkState::Connected; });
}
