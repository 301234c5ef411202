#include "foundation/math/elementary.h"
#include "foundation/random/philox.h"
#include "simulation/emitters/births/birth_shape.h"
#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/birth_lanes.h"
#include "tests/simulation/particles/core/sprites.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace fx;
using namespace fx::sim;

namespace {

std::vector<Birth> births(uint64_t first, uint32_t count)
{
    std::vector<Birth> list;
    for (uint32_t i = 0; i < count; ++i)
        list.push_back({first + i, base::Ticks(i) * 1000});
    return list;
}

} // namespace

TEST(BirthKernel, itsRandomNumbersArePhiloxForEveryCount)
{
    BirthTile tile;
    for (const uint32_t count : {1u, 7u, 16u, 250u}) {
        tile.count = count;
        const uint64_t first = (uint64_t(1) << 32) - 5; // the high word changes within
        for (uint32_t i = 0; i < kTileRows; ++i) {
            tile.indexLow[i] = uint32_t(first + i);
            tile.indexHigh[i] = uint32_t((first + i) >> 32);
        }
        drawUnits(tile, 0x123456789ABCDEFull, 3, uint32_t(base::RandomPurpose::Life), tile.u);
        for (uint32_t i = 0; i < count; ++i) {
            const auto want =
                base::randomUnit4(0x123456789ABCDEFull, 3, first + i, base::RandomPurpose::Life);
            for (size_t k = 0; k < 4; ++k)
                ASSERT_EQ(tile.u[k][i], want[k]) << i;
        }
    }
}

TEST(BirthKernel, placesAndVelocitiesAreThoseOfTheScalarShapes)
{
    for (const EmitterShape shape :
         {EmitterShape::Point, EmitterShape::Sphere, EmitterShape::Box, EmitterShape::Cone})
    {
        EmitterDef def;
        def.shape = shape;
        def.size = {2, 1, 3};
        def.angle = 0.7f;
        def.position = {1, 2, 3};
        def.speed = {1, 5};
        def.forces.bounce = 0.5f; // integrated: places are stored
        base::HostMemory memory;
        const ParticleProgram program(def);
        ParticleStore store(program, &memory);
        EXPECT_EQ(storeBirths(program, {77, 2}, births(100, 600), store), 600u);
        for (uint64_t i = 100; i < 700; ++i) {
            const auto draw = [&](base::RandomPurpose purpose) {
                return base::randomUnit4(77, 2, i, purpose);
            };
            const BirthPlace want =
                sampleBirth(def, draw(base::RandomPurpose::Position), draw(base::RandomPurpose::Direction));
            const float speed = def.speed.at(draw(base::RandomPurpose::Life)[1]);
            const uint32_t row = store.rowOf(i);
            ASSERT_EQ(store.index[row], i);
            for (size_t a = 0; a < 3; ++a) {
                ASSERT_NEAR(store.values[stored::X + a][row], want.position[int(a)], 3e-6f) << i;
                ASSERT_NEAR(store.values[stored::VelocityX + a][row], speed * want.direction[int(a)], 3e-6f)
                    << i;
            }
        }
    }
}

TEST(BirthKernel, aRowThatIsTakenIsNotGivenAway)
{
    EmitterDef def;
    def.maxParticles = 10;
    def.lifetime = {100, 100};
    base::HostMemory memory;
    const ParticleProgram program(def);
    ParticleStore store(program, &memory);
    EXPECT_EQ(storeBirths(program, {1, 0}, births(0, 8), store), 8u);
    store.advance(8);
    EXPECT_EQ(storeBirths(program, {1, 0}, births(8, 6), store), 2u); // rows 8 and 9, then 0 to 3 are taken
    store.advance(6);
    for (uint64_t row = 0; row < 10; ++row)
        EXPECT_EQ(store.index[row], row);
}
