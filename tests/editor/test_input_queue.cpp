#include "fxsdk/editor/session/input_queue.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

constexpr int kControl = 341, kAlt = 342, kEnter = 257, kLeft = 263; // of GLFW

InputEvent key(int code, bool isDown)
{
    return {InputKind::Key, code, isDown, 0.0, 0.0};
}
InputEvent typed(int code)
{
    return {InputKind::Text, code, false, 0.0, 0.0};
}
InputEvent button(bool isDown)
{
    return {InputKind::Button, 0, isDown, 0.0, 0.0};
}
InputEvent motion(double x)
{
    return {InputKind::Motion, 0, false, x, 0.0};
}

/// Number of events of each frame until none is left.
std::vector<size_t> framesOf(InputQueue& queue)
{
    std::vector<size_t> counts;
    while (queue.size() > 0)
        counts.push_back(queue.take().size());
    return counts;
}

TEST(InputQueue, aPressAndItsReleaseAreSeenByTwoFrames)
{
    InputQueue queue;
    queue.push(key('Z', true));
    queue.push(key('Z', false));
    queue.push(key('Z', true));
    EXPECT_EQ(queue.take(), std::vector{key('Z', true)});
    EXPECT_EQ(queue.take(), std::vector{key('Z', false)});
    EXPECT_EQ(queue.take(), std::vector{key('Z', true)});
    EXPECT_TRUE(queue.take().empty());
}

TEST(InputQueue, aModifierIsDownInTheFrameOfItsKey)
{
    InputQueue queue;
    for (const auto& event : {key(kControl, true), key('Z', true), key(kControl, false), key('Z', false)})
        queue.push(event);
    EXPECT_EQ(queue.take(), (std::vector{key(kControl, true), key('Z', true)}));
    EXPECT_EQ(queue.take(), (std::vector{key(kControl, false), key('Z', false)}));
}

TEST(InputQueue, aModifierHoldsForWhatFollowsItAlone)
{
    InputQueue queue;
    queue.push(key(kControl, true));
    (void)queue.take();
    for (const auto& event : {key('Z', true), key(kControl, false), key('Z', false)})
        queue.push(event);
    EXPECT_EQ(queue.take(), std::vector{key('Z', true)}); // with Ctrl, which is released after it
    EXPECT_EQ(queue.take(), (std::vector{key(kControl, false), key('Z', false)}));
    const InputEvent wheel{InputKind::Wheel, 0, false, 0.0, 1.0};
    for (const InputEvent& first : {key('Z', true), typed('z'), button(true), wheel}) {
        queue.push(first);
        queue.push(key(kAlt, true));
        queue.push(key(kAlt, false));
        EXPECT_EQ(framesOf(queue), (std::vector<size_t>{1, 1, 1}));
    }
    queue.push(motion(1.0));
    queue.push(key(kControl, true));
    queue.push(key(kAlt, true));
    queue.push(key('Z', true));
    EXPECT_EQ(framesOf(queue), std::vector<size_t>{4});
}

TEST(InputQueue, textIsTypedTogetherAndEnteredAfterIt)
{
    InputQueue queue;
    for (const int letter : {'1', '2', '3'}) {
        queue.push(key(letter, true));
        queue.push(typed(letter));
        queue.push(key(letter, false));
    }
    queue.push(key(kEnter, true));
    queue.push(typed('4')); // belongs to what follows
    size_t frames = 0, characters = 0;
    bool isEntered = false;
    while (queue.size() > 0) {
        ++frames;
        for (const InputEvent& event : queue.take()) {
            characters += event.kind == InputKind::Text && !isEntered;
            isEntered = isEntered || event == key(kEnter, true);
        }
    }
    EXPECT_EQ(characters, 3u);
    EXPECT_LE(frames, 5u); // one for each letter and its release at most
}

TEST(InputQueue, aClickIsWhereTheMouseWas)
{
    InputQueue queue;
    for (const auto& event : {motion(5.0), button(true), motion(80.0), button(false), motion(90.0)})
        queue.push(event);
    EXPECT_EQ(queue.take(), (std::vector{motion(5.0), button(true)}));
    EXPECT_EQ(queue.take(), (std::vector{motion(80.0), button(false)}));
    EXPECT_EQ(queue.take(), std::vector{motion(90.0)});
}

TEST(InputQueue, commandsWaitForEachOtherAndMotionsJoin)
{
    InputQueue queue;
    queue.push(key(kLeft, true));
    queue.push(key(kEnter, true));
    EXPECT_EQ(framesOf(queue), (std::vector<size_t>{1, 1}));
    for (int i = 0; i < 100; ++i)
        queue.push(motion(i));
    EXPECT_EQ(queue.take(), std::vector{motion(99.0)});
}

TEST(InputQueue, whatIsDownIsReleasedWhenTheWindowLosesTheKeyboard)
{
    InputQueue queue;
    queue.push(key('A', true));
    queue.push(key('B', true));
    queue.push(key('B', false));
    queue.push(button(true));
    (void)framesOf(queue);
    queue.releaseAll();
    EXPECT_EQ(queue.take(), (std::vector{key('A', false), button(false)}));
    queue.releaseAll();
    EXPECT_TRUE(queue.take().empty());
}

TEST(InputQueue, aBacklogIsTakenAtOnce)
{
    InputQueue queue;
    for (size_t i = 0; i < InputQueue::kMost; ++i) {
        queue.push(key('A', true));
        queue.push(key('A', false));
    }
    EXPECT_EQ(queue.take().size(), 2 * InputQueue::kMost);
}

} // namespace
} // namespace fx::editor
