// The coordinates that a gas carries.
#include "simulation/detail/material_coordinates.h"
#include "tests/simulation/detail/detail_stage.h"
#include "tests/simulation/gas_cloud.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

using namespace fx;
using namespace fx::test;

namespace {

std::unique_ptr<sim::GasDef> detailedFireball(uint32_t particles = 150)
{
    auto def = fireball(particles);
    def->detail.given = true;
    def->detail.material = sim::DetailMaterial::Fireball;
    return def;
}

} // namespace

TEST(GasDetail, leavesWhatWasThereBeforeAsItIs)
{
    Stage plain, detailed;
    plain.add({}, fireball(150));
    detailed.add({}, detailedFireball());
    for (int i = 0; i < 4; ++i) {
        plain.play(15);
        detailed.play(15);
        const DetailGroups before(plain.look()), with(detailed.look());
        EXPECT_EQ(before.material, nullptr);
        ASSERT_NE(with.material, nullptr);
        EXPECT_EQ(allOf(*before.blobs, base::blob_column::Count),
                  allOf(*with.blobs, base::blob_column::Count));
        EXPECT_EQ(std::vector(with.blobs->ids().begin(), with.blobs->ids().end()),
                  std::vector(with.material->ids().begin(), with.material->ids().end()));
    }
}

TEST(GasDetail, aCoordinateIsThePlaceAtBirthAsLongAsTheGenerationLives)
{
    Stage stage;
    stage.add({}, detailedFireball());
    stage.play(10);
    uint32_t births = 0;
    for (int i = 0; i < 60; ++i) {
        const DetailGroups before(stage.look());
        const uint32_t younger = before.younger();
        std::vector<glm::vec3> places;
        for (size_t b = 0; b < before.blobs->count(); ++b)
            places.push_back(before.place(younger, b));
        stage.play(1);
        const DetailGroups now(stage.look());
        for (size_t b = 0; b < places.size(); ++b) {
            EXPECT_EQ(now.place(younger, b), places[b]);
            if (now.younger() > younger) {
                EXPECT_EQ(now.place(now.younger(), b), now.position(b));
            }
        }
        births += now.younger() - younger;
        EXPECT_GE(now.fade(), 0.0f);
        EXPECT_LE(now.fade(), 1.0f);
    }
    EXPECT_GE(births, 2u);
    EXPECT_LE(births, uint32_t(sim::kMaxGenerationRate) + 1);
}

TEST(GasDetail, livelinessRenewsItMoreOften)
{
    const auto births = [](float liveliness) {
        Stage stage;
        auto def = detailedFireball();
        def->detail.liveliness = liveliness;
        stage.add({}, std::move(def));
        stage.play(60);
        return DetailGroups(stage.look()).younger();
    };
    EXPECT_LT(births(0.3f), births(1.0f));
}

TEST(GasDetail, lumpsAreAsLargeAsBallsAndGrowWithThem)
{
    Stage stage;
    stage.add({}, detailedFireball());
    stage.play(40);
    const DetailGroups now(stage.look());
    std::vector<float> radii(now.blobs->column(base::blob_column::Radius).begin(),
                             now.blobs->column(base::blob_column::Radius).end());
    std::ranges::nth_element(radii, radii.begin() + std::ptrdiff_t(radii.size() / 2));
    for (size_t g = 0; g < 2; ++g) {
        const float length = now.material->constants()[constant::Length0 + g];
        const float growth = now.material->constants()[constant::Growth0 + g];
        EXPECT_NEAR(length / growth, 1.1f * radii[radii.size() / 2], 1e-4f);
    }
}
