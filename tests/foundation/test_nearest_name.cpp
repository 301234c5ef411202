#include "foundation/result/nearest_name.h"

#include <gtest/gtest.h>

#include <vector>

using namespace fx::base;

TEST(NearestName, countsInsertionsDeletionsReplacementsAndSwaps)
{
    EXPECT_EQ(editDistance("radius", "radius"), 0u);
    EXPECT_EQ(editDistance("radus", "radius"), 1u);
    EXPECT_EQ(editDistance("radiuss", "radius"), 1u);
    EXPECT_EQ(editDistance("radous", "radius"), 1u);
    EXPECT_EQ(editDistance("raduis", "radius"), 1u);
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
    EXPECT_EQ(editDistance("", "abc"), 3u);
}

TEST(NearestName, ignoresLetterCase)
{
    EXPECT_EQ(editDistance("SubSteps", "subSteps"), 0u);
}

TEST(NearestName, isSymmetric)
{
    EXPECT_EQ(editDistance("emission", "emitters"), editDistance("emitters", "emission"));
}

TEST(NearestName, proposesTheClosestAndNothingThatIsFar)
{
    const std::vector<std::string> known{"rate", "start", "duration", "radius"};
    EXPECT_EQ(nearestName("raduis", known), "radius");
    EXPECT_EQ(nearestName("rat", known), "rate");
    EXPECT_EQ(nearestName("temperature", known), std::nullopt);
    EXPECT_EQ(nearestName("", known), std::nullopt);
}

TEST(NearestName, theQuestionNamesTheNearestAndIsEmptyWithoutOne)
{
    const std::vector<std::string> known{"rate", "radius"};
    EXPECT_EQ(didYouMean("raduis", known), "; did you mean \"radius\"?");
    EXPECT_EQ(didYouMean("temperature", known), "");
}

TEST(NearestName, takesNamesOfAnyLength)
{
    const std::vector<std::string> known{std::string(1000, 'b')};
    EXPECT_EQ(nearestName(std::string(5000, 'a'), known), std::nullopt);
}
