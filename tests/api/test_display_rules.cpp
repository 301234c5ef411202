// Rules of drawing instances, which outlast the instances in published snapshots.
#include "fxsdk/scene/display_rules.h"

#include <gtest/gtest.h>

using fx::scene::DisplayRules;
using fx::scene::InstanceRule;

namespace {

std::pmr::vector<InstanceRule> all(const DisplayRules& rules)
{
    std::pmr::vector<InstanceRule> copied;
    uint64_t revision = 0;
    rules.copy(copied, revision);
    return copied;
}

} // namespace

TEST(DisplayRules, ruleOfADestroyedInstanceEndsAfterItsLastSnapshots)
{
    DisplayRules rules(std::pmr::get_default_resource());
    rules.setOrder(1, 3, 0);
    rules.setMask(2, 0);
    rules.retire(1, 8);
    rules.retire(7, 8); // has no rule
    int publications = 0;
    for (; all(rules).size() == 2 && publications < 100; ++publications)
        rules.countPublication();
    EXPECT_GE(publications, 3); // two snapshots that views show, and one in work
    EXPECT_LE(publications, 8);
    ASSERT_EQ(all(rules).size(), 1u);
    EXPECT_EQ(all(rules).front().instance, 2u); // it exists
    EXPECT_EQ(rules.of(1).layer, 0);
}

TEST(DisplayRules, keepsAtMostAsManyEntriesOfDestroyedInstancesAsAsked)
{
    DisplayRules rules(std::pmr::get_default_resource());
    for (uint64_t id = 1; id <= 100; ++id) { // a scene that publishes nothing
        rules.setOrder(id, 1, 0);
        rules.retire(id, 4);
    }
    EXPECT_EQ(all(rules).size(), 4u);
    std::pmr::vector<InstanceRule> none;
    rules.replace(none);
    rules.setOrder(200, 1, 0);
    rules.retire(200, 4);
    EXPECT_EQ(all(rules).size(), 1u);
}
