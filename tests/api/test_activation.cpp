#include "fxsdk/activation/active_list.h"
#include "fxsdk/activation/timer_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using fx::activation::ActiveList;
using fx::activation::Timer;
using fx::activation::TimerQueue;

namespace {

/// Keys in the order in which they leave the queue.
std::vector<uint32_t> drain(TimerQueue& queue)
{
    std::vector<uint32_t> keys;
    while (!queue.empty()) {
        keys.push_back(queue.earliest().key);
        queue.remove(keys.back());
    }
    return keys;
}

} // namespace

TEST(TimerQueue, theEarliestStartComesFirstAndEqualStartsInOrderOfCreation)
{
    TimerQueue queue(std::pmr::get_default_resource());
    queue.add({30, 0, 4});
    queue.add({10, 1, 2});
    queue.add({20, 2, 9});
    queue.add({10, 3, 0});
    EXPECT_EQ(drain(queue), (std::vector<uint32_t>{2, 0, 9, 4}));
}

TEST(TimerQueue, afterRemovalsFromAnywhereTheOthersStillComeInOrder)
{
    for (uint32_t removed = 0; removed < 40; ++removed) {
        TimerQueue queue(std::pmr::get_default_resource());
        std::vector<Timer> wanted;
        for (uint32_t key = 0; key < 40; ++key) {
            const Timer timer{int64_t((key * 37 + 11) % 23), key, key};
            queue.add(timer);
            if (key != removed && key % 7 != 3)
                wanted.push_back(timer);
        }
        for (uint32_t key = 0; key < 40; ++key)
            if (key == removed || key % 7 == 3)
                queue.remove(key);
        std::stable_sort(wanted.begin(), wanted.end(),
                         [](const Timer& a, const Timer& b) { return a.start < b.start; });
        std::vector<uint32_t> keys;
        for (const Timer& timer : wanted)
            keys.push_back(timer.key);
        EXPECT_EQ(drain(queue), keys);
    }
}

TEST(TimerQueue, fiveHundredTimersStayInOrderWhicheverHalfLeaves)
{
    uint64_t random = 1;
    const auto next = [&random] {
        return (random = random * 6364136223846793005u + 1442695040888963407u) >> 33;
    };
    for (int round = 0; round < 50; ++round) {
        TimerQueue queue(std::pmr::get_default_resource());
        std::vector<Timer> waiting;
        for (uint32_t key = 0; key < 500; ++key) {
            waiting.push_back({int64_t(next() % 1000), key, key});
            queue.add(waiting.back());
        }
        for (int i = 0; i < 250; ++i) {
            const size_t leaves = next() % waiting.size();
            queue.remove(waiting[leaves].key);
            waiting.erase(waiting.begin() + std::ptrdiff_t(leaves));
        }
        std::stable_sort(waiting.begin(), waiting.end(),
                         [](const Timer& a, const Timer& b) { return a.start < b.start; });
        const std::vector<uint32_t> keys = drain(queue);
        ASSERT_EQ(keys.size(), waiting.size());
        for (size_t i = 0; i < keys.size(); ++i)
            ASSERT_EQ(keys[i], waiting[i].key) << "round " << round;
    }
}

TEST(ActiveList, theOrderIsThatOfCreationWhateverTheOrderOfWaking)
{
    ActiveList list(std::pmr::get_default_resource());
    list.insert(5, 50, 500);
    list.insert(1, 10, 100);
    list.insert(3, 30, 300);
    EXPECT_EQ(std::vector<uint32_t>(list.keys().begin(), list.keys().end()),
              (std::vector<uint32_t>{10, 30, 50}));
    list.remove(3);
    EXPECT_EQ(std::vector<uint32_t>(list.slots().begin(), list.slots().end()),
              (std::vector<uint32_t>{100, 500}));
}

TEST(ActiveList, removingManyAtOnceKeepsTheOrderOfTheOthers)
{
    ActiveList list(std::pmr::get_default_resource());
    for (uint32_t i = 0; i < 10; ++i)
        list.insert(i, i, i + 100);
    list.removeIf([](uint32_t key, uint32_t slot) {
        EXPECT_EQ(slot, key + 100);
        return key % 3 == 0;
    });
    EXPECT_EQ(std::vector<uint32_t>(list.keys().begin(), list.keys().end()),
              (std::vector<uint32_t>{1, 2, 4, 5, 7, 8}));
}
