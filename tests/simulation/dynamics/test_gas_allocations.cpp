#include "tests/api/counting_new.h"
#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

#include <memory_resource>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// Counts what is asked of the default resource.
class CountingResource final : public std::pmr::memory_resource
{
public:
    uint64_t calls = 0;

private:
    void* do_allocate(size_t bytes, size_t alignment) override
    {
        ++calls;
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* memory, size_t bytes, size_t alignment) override
    {
        std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

} // namespace

TEST(GasAllocations, advanceMakesNoneAfterTheFirst)
{
    for (const StepScheme steps : {StepScheme::Global, StepScheme::Block}) {
        CountingResource memory;
        std::vector<GasParticle> particles = lattice(12, 1e-6);
        heatNearest(particles, glm::dvec3(0.5), 32, 1.0);
        GasDynamics<float> gas(periodicBox(12, steps), &memory);
        const auto tasks = base::makeSerialRunner();
        ASSERT_TRUE(gas.add(particles).ok());
        ASSERT_TRUE(gas.advance(0.005, *tasks).ok());
        gas.injectLater(7, 0.1, 0.001); // the list of later heat takes its size
        ASSERT_TRUE(gas.advance(0.005, *tasks).ok());

        const uint64_t before = newCalls();
        const uint64_t askedBefore = memory.calls;
        uint64_t searches = 0;
        for (int i = 0; i < 8; ++i) {
            gas.inject(17, 0.01);
            gas.injectLater(99, 0.01, 0.0005);
            gas.view().vx[3] += 0.01f;
            gas.edited();
            const auto report = gas.advance(0.002, *tasks);
            ASSERT_TRUE(report.ok());
            searches += report->searches;
        }
        EXPECT_EQ(newCalls() - before, 0u);
        EXPECT_EQ(memory.calls - askedBefore, 0u);
        EXPECT_GT(searches, 1u);
    }
}

TEST(GasAllocations, theCountersCount)
{
    const uint64_t before = newCalls();
    CountingResource memory;
    const GasDynamics<float> gas(periodicBox(4), &memory);
    EXPECT_GT(newCalls(), before);
    EXPECT_GT(memory.calls, 0u);
}
