#include "simulation/emitters/births/birth_shape.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::sim;

namespace {

constexpr int kSamples = 40000;

EmitterSettings shaped(EmitterShape shape, glm::vec3 size, float angle = 0)
{
    EmitterSettings def;
    def.shape = shape;
    def.size = size;
    def.angle = angle;
    return def;
}

template <class F>
void forEachSample(const EmitterSettings& def, F&& f)
{
    for (int i = 0; i < kSamples; ++i)
        f(sampleBirth(def, base::randomUnit4(5, 0, uint64_t(i), base::RandomPurpose::Position),
                      base::randomUnit4(5, 0, uint64_t(i), base::RandomPurpose::Direction)));
}

} // namespace

TEST(BirthShape, directionsAreUnitLength)
{
    for (const EmitterShape shape :
         {EmitterShape::Point, EmitterShape::Sphere, EmitterShape::Box, EmitterShape::Cone})
        forEachSample(shaped(shape, glm::vec3(2.0f), 0.7f),
                      [](const BirthPlace& b) { ASSERT_NEAR(glm::length(b.direction), 1.0f, 1e-5f); });
}

TEST(BirthShape, aPointIsWhereItIsAndPointsEverywhereAlike)
{
    EmitterSettings def = shaped(EmitterShape::Point, {});
    def.position = {1, 2, 3};
    glm::dvec3 mean(0.0);
    double verticalSquared = 0;
    forEachSample(def, [&](const BirthPlace& b) {
        ASSERT_EQ(b.position, def.position);
        mean += glm::dvec3(b.direction) / double(kSamples);
        verticalSquared += double(b.direction.y) * double(b.direction.y) / kSamples;
    });
    EXPECT_LT(glm::length(mean), 0.02);
    EXPECT_NEAR(verticalSquared, 1.0 / 3.0, 0.01);
}

TEST(BirthShape, theBallIsFilledEvenly)
{
    // Below radius r lies the part (r/R)^3 of the volume: eight shells of equal volume hold equal numbers.
    int shells[8] = {};
    forEachSample(shaped(EmitterShape::Sphere, {2, 0, 0}), [&](const BirthPlace& b) {
        const float r = glm::length(b.position);
        ASSERT_LE(r, 2.0001f);
        if (r > 0.01f) {
            ASSERT_NEAR(glm::dot(b.position / r, b.direction), 1.0f, 1e-4f); // heads outwards
        }
        ++shells[std::min(int(r * r * r), 7)];
    });
    double chiSquare = 0;
    for (const int n : shells)
        chiSquare += std::pow(n - kSamples / 8.0, 2) / (kSamples / 8.0);
    EXPECT_LT(chiSquare, 18.5); // 7 degrees of freedom, 1 %
}

TEST(BirthShape, theBoxIsFilledEvenlyAndPointsUp)
{
    int octants[8] = {};
    forEachSample(shaped(EmitterShape::Box, {1, 2, 3}), [&](const BirthPlace& b) {
        ASSERT_LE(std::abs(b.position.x), 1.0f);
        ASSERT_LE(std::abs(b.position.y), 2.0f);
        ASSERT_LE(std::abs(b.position.z), 3.0f);
        ASSERT_EQ(b.direction, glm::vec3(0, 1, 0));
        ++octants[(b.position.x > 0) + 2 * (b.position.y > 0) + 4 * (b.position.z > 0)];
    });
    double chiSquare = 0;
    for (const int n : octants)
        chiSquare += std::pow(n - kSamples / 8.0, 2) / (kSamples / 8.0);
    EXPECT_LT(chiSquare, 18.5);
}

TEST(BirthShape, theConeStaysWithinItsAngleAndItsDisc)
{
    const float angle = 0.5f;
    double meanCosine = 0;
    double meanRadiusSquared = 0;
    forEachSample(shaped(EmitterShape::Cone, {3, 0, 0}, angle), [&](const BirthPlace& b) {
        ASSERT_GE(b.direction.y, std::cos(angle) - 1e-5f);
        ASSERT_EQ(b.position.y, 0.0f);
        meanCosine += double(b.direction.y) / kSamples;
        meanRadiusSquared += double(glm::dot(b.position, b.position)) / kSamples;
    });
    EXPECT_NEAR(meanCosine, 0.5 * (1.0 + std::cos(double(angle))), 1e-3); // uniform in solid angle
    EXPECT_NEAR(meanRadiusSquared, 4.5, 0.05);                            // uniform in area: R^2 / 2
}

TEST(BirthShape, aConeOfNoAngleIsABeamAndOneOfPiASphere)
{
    forEachSample(shaped(EmitterShape::Cone, {}, 0.0f),
                  [](const BirthPlace& b) { ASSERT_EQ(b.direction, glm::vec3(0, 1, 0)); });
    float lowest = 1;
    forEachSample(shaped(EmitterShape::Cone, {}, 100.0f),
                  [&](const BirthPlace& b) { lowest = std::min(lowest, b.direction.y); });
    EXPECT_LT(lowest, -0.999f);
}
