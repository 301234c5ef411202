// The order that the GPU finds against DepthSort.
#include "gpu_fixture.h"

#include "foundation/random/philox.h"
#include "rendering/draw_order/depth_keys.h"
#include "rendering/draw_order/depth_sort.h"
#include "rendering/gpu_particles/gpu_order_pass.h"

#include <limits>

namespace fx::test {

namespace {

/// x, y, z, age, radius column by column, as they lie in a buffer.
struct TestRows
{
    explicit TestRows(uint32_t n) : count(n), values(5 * size_t(n))
    {
        for (uint32_t i = 0; i < n; ++i) {
            const auto u = base::randomUnit4(5, 0, i, base::RandomPurpose::Position);
            const auto w = base::randomUnit4(5, 0, i, base::RandomPurpose::Life);
            for (size_t a = 0; a < 3; ++a)
                values[a * n + i] = 8.0f * u[a] - 4.0f;
            if (i % 7 == 3) // some as far as others
                values[i] = values[n + i] = values[2 * n + i] = 1.0f;
            values[3 * n + i] = w[0];
            values[4 * n + i] = w[1] < 0.2f ? 0.0f : 0.1f;
        }
    }
    const float* column(size_t c) const { return values.data() + c * count; }

    uint32_t count;
    std::vector<float> values;
};

} // namespace

class GpuOrder : public GpuParticleTest
{
protected:
    std::vector<uint32_t> ordered(const TestRows& rows, render::GpuOrderJob job, uint32_t* outLiving,
                                  uint32_t radixFrom = render::kRadixOrderRows)
    {
        auto buffer = render::GlBuffer::create(*device_, rows.values.size() * 4, "rows");
        device_->gl.NamedBufferSubData(buffer->name(), 0, GLsizeiptr(buffer->bytes()), rows.values.data());
        render::ParticleBatch batch{};
        batch.newer = {buffer->name(), {}, 0, buffer->bytes()};
        const auto n = int32_t(rows.count);
        batch.block.newerAt = {0, n, 2 * n, 3 * n, 4 * n};
        batch.block.rows[0] = n;
        graph_->begin();
        batch.newer.id = graph_->importBuffer({"rows", buffer->bytes()}, buffer->name());
        render::GpuOrderPass::addTo(*graph_, {&job, 1}, {&batch, 1}, radixFrom);
        graph_->keep(batch.order.id);
        graph_->keep(batch.arguments);
        graph_->compile();
        EXPECT_TRUE(backend_->beginFrame(*graph_).ok());
        graph_->execute(*backend_);
        EXPECT_TRUE(backend_->endFrame().ok());
        uint32_t arguments[4];
        std::vector<uint32_t> order(rows.count);
        device_->gl.GetNamedBufferSubData(backend_->bufferName(batch.arguments), 0, 16, arguments);
        device_->gl.GetNamedBufferSubData(backend_->bufferName(batch.order.id), 0,
                                          GLsizeiptr(4 * order.size()), order.data());
        EXPECT_EQ(arguments[0], 6u);
        EXPECT_EQ(arguments[2] + arguments[3], 0u);
        *outLiving = arguments[1];
        order.resize(std::min(arguments[1], rows.count));
        return order;
    }
};

TEST_F(GpuOrder, isThatOfTheCpu)
{
    for (const uint32_t count : {1u, 5u, 1023u, 1024u, 1025u, 4097u, 40'000u})
        for (int mode = 0; mode < 4; ++mode) {
            SCOPED_TRACE(std::to_string(count) + " rows, mode " + std::to_string(mode));
            const TestRows rows(count);
            const bool byAge = mode >= 2, isParallel = mode == 1, leastFirst = mode == 3;
            const glm::vec3 eye = isParallel ? glm::vec3(0.6f, 0.0f, -0.8f) : glm::vec3(3.0f, 1.0f, 9.0f);
            std::vector<float> distances(count);
            if (byAge)
                for (uint32_t i = 0; i < count; ++i)
                    distances[i] = rows.column(4)[i] > 0.0f ? rows.column(3)[i] : render::DepthSort::kAbsent;
            else
                render::rowDistances({rows.column(0), rows.column(1), rows.column(2), rows.column(4), count},
                                     eye, isParallel, 2.0f, -0.25f, distances.data());
            render::DepthSort sort(std::pmr::get_default_resource());
            const auto want = leastFirst ? sort.nearestFirst(distances) : sort.farthestFirst(distances);
            uint32_t living = 0;
            const auto got = ordered(rows, {0, byAge, leastFirst, isParallel, eye, 2.0f, -0.25f}, &living);
            ASSERT_EQ(living, want.size());
            uint32_t byRadix = 0;
            EXPECT_EQ(ordered(rows, {0, byAge, leastFirst, isParallel, eye, 2.0f, -0.25f}, &byRadix, 0), got);
            EXPECT_EQ(byRadix, living);
            const auto squared = [&](uint32_t row) { // what both take the root of
                const glm::vec3 d =
                    glm::vec3(rows.column(0)[row], rows.column(1)[row], rows.column(2)[row]) - eye;
                return d.x * d.x + d.y * d.y + d.z * d.z;
            };
            const auto areTied = [&](uint32_t a, uint32_t b) {
                return distances[a] == distances[b] && (byAge || isParallel || squared(a) == squared(b));
            };
            // Distances are the same within the rounding of a square root; most are equal bit for bit.
            for (size_t i = 0; i < want.size(); ++i)
                ASSERT_NEAR(distances[got[i]], distances[want[i]], 2e-6f * std::abs(distances[want[i]])) << i;
            for (size_t i = 1; i < got.size(); ++i)
                ASSERT_TRUE(!areTied(got[i - 1], got[i]) || got[i - 1] < got[i])
                    << "equally far, but not in order of rows: " << i;
        }
}

TEST_F(GpuOrder, ofNobodyDrawsNothing)
{
    TestRows rows(2000);
    std::fill_n(rows.values.begin() + 4 * 2000, 2000, 0.0f);
    uint32_t living = 1;
    ordered(rows, {0, false, false, false, glm::vec3(1.0f), 1.0f, 0.0f}, &living);
    EXPECT_EQ(living, 0u);
}

} // namespace fx::test
