// The loop of an emitter: periodic, continuous, and a function of time.
#include "block_fixture.h"
#include "simulation/blocks/block_loop.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace fx;
using namespace fx::test;

namespace {

namespace blob = base::blob_column;

constexpr float kPeriod = 2.0f;

std::shared_ptr<const sim::BlockLoop> boilingLoop(float rate = 30.0f)
{
    sim::BlockLoop::Settings settings;
    settings.period = kPeriod;
    settings.frames = 20;
    auto loop = sim::BlockLoop::record(*boiling(rate), settings);
    EXPECT_TRUE(loop.ok()) << loop.status().message();
    return *loop;
}

/// The balls of a loop at one time.
class Balls
{
public:
    Balls(const sim::BlockLoop& loop, base::Ticks time) : group_(std::pmr::get_default_resource())
    {
        group_.prepare(blockSchema(), blockSchema().find(base::kBlockBallKind.name), loop.maxBalls());
        group_.editInfo().count = loop.write(time, group_);
    }
    const base::SnapshotGroup& group() const { return group_; }
    double sum(size_t column) const
    {
        double sum = 0;
        for (const float value : group_.column(column))
            sum += double(value);
        return sum;
    }

private:
    base::SnapshotGroup group_;
};

} // namespace

TEST(BlockLoop, repeatsExactly)
{
    const auto loop = boilingLoop();
    for (const double share : {0.0, 0.31, 0.5, 0.99}) {
        const auto time = 4 * loop->period() + base::Ticks(share * double(loop->period()));
        const Balls now(*loop, time), later(*loop, time + 3 * loop->period());
        ASSERT_GT(now.group().count(), 0u);
        for (size_t column = 0; column < blob::Count; ++column)
            EXPECT_TRUE(std::ranges::equal(now.group().column(column), later.group().column(column)));
    }
}

TEST(BlockLoop, movesWithoutJumpsAlsoWhereItBeginsAgain)
{
    const auto loop = boilingLoop();
    const base::Ticks step = loop->period() / 400;
    std::map<uint64_t, glm::vec3> before;
    double amount = -1.0;
    for (base::Ticks time = 0; time < 3 * loop->period(); time += step) {
        const Balls balls(*loop, time);
        std::map<uint64_t, glm::vec3> now;
        for (size_t i = 0; i < balls.group().count(); ++i) {
            const glm::vec3 place = positionOf(balls.group(), i);
            const uint64_t id = balls.group().ids()[i];
            now[id] = place;
            if (const auto found = before.find(id); found != before.end()) {
                EXPECT_LE(glm::length(place - found->second), 4.0f * float(base::toSeconds(step)));
            } else if (time > 0) {
                EXPECT_LE(balls.group().column(blob::CrossSection)[i], 0.2f); // it has just appeared
            }
        }
        EXPECT_EQ(now.size(), balls.group().count()); // ids are unique
        const auto ids = balls.group().ids();
        EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
        before = now;
        const double sum = balls.sum(blob::CrossSection);
        if (amount >= 0.0) {
            EXPECT_LE(std::abs(sum - amount), 0.05 * amount + 0.3);
        }
        amount = sum;
    }
}

TEST(BlockLoop, idsStayUniqueAndSortedWhenTheNumberOfPeriodsWraps)
{
    const auto loop = boilingLoop();
    for (base::Ticks periods = 0; periods < 40; ++periods) {
        const Balls balls(*loop, periods * loop->period() + loop->period() / 3);
        const auto ids = balls.group().ids();
        EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end())) << periods;
        EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end()) << periods;
        EXPECT_LT(ids.back(), loop->span());
    }
}

TEST(BlockLoop, hasAsMuchMediumAsTheEmitterInItsSteadyState)
{
    const auto loop = boilingLoop(60.0f);
    const Balls balls(*loop, loop->period() / 2);
    // births per second times the mean life
    EXPECT_NEAR(double(balls.group().count()), 60.0 * 2.0, 20.0);
}

TEST(BlockLoop, neverLeavesItsRadius)
{
    const auto loop = boilingLoop();
    for (int i = 0; i < 100; ++i) {
        const Balls balls(*loop, loop->period() * i / 37);
        for (size_t k = 0; k < balls.group().count(); ++k)
            EXPECT_LE(glm::length(positionOf(balls.group(), k)) + balls.group().column(blob::Radius)[k],
                      loop->radius());
    }
}

TEST(BlockLoop, refusesWhatTakesTooManySteps)
{
    const auto slow = boiling(5000.0f);
    slow->maxParticles = 20000;
    sim::BlockLoop::Settings settings;
    settings.period = 600.0f;
    settings.frames = 2;
    settings.maxWork = 1u << 18;
    const auto loop = sim::BlockLoop::record(*slow, settings);
    ASSERT_EQ(loop.status().code(), base::Code::TooLarge);
    EXPECT_NE(loop.status().message().find("particle steps"), std::string::npos) << loop.status().message();
}

TEST(BlockLoop, refusesWhatIsTooLargeOrEmpty)
{
    sim::BlockLoop::Settings settings;
    settings.frames = 256;
    const auto many = boiling(4000.0f);
    many->maxParticles = 20000;
    const auto large = sim::BlockLoop::record(*many, settings);
    EXPECT_EQ(large.status().code(), base::Code::TooLarge);
    const auto empty = sim::BlockLoop::record(*boiling(0.0f), settings);
    EXPECT_EQ(empty.status().code(), base::Code::InvalidArgument);
    settings.period = 0.1f;
    settings.frames = 2;
    EXPECT_EQ(sim::BlockLoop::record(*boiling(), settings).status().code(), base::Code::InvalidArgument);
}
