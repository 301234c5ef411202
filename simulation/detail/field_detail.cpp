#include "simulation/detail/field_detail.h"

#include "foundation/snapshot/material_kind.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::sim {

namespace {

namespace constant = base::material_constant;

constexpr float kLumpsPerRadius = 1.1f; ///< length of a lump over the median radius of balls

/// Optical depths of a lump between which the medium is eroded, and what becomes of its temperature.
struct MaterialNumbers
{
    float thinnest, densest; ///< [1]
    float cooling, glow;     ///< [1]
};

constexpr MaterialNumbers numbersOf(DetailMaterial material)
{
    switch (material) {
    case DetailMaterial::Fireball:
        return {0.6f, 40.0f, 0.16f, 0.09f};
    case DetailMaterial::Steam:
        return {0.2f, 12.0f, 0.0f, 0.0f};
    case DetailMaterial::Dust:
        return {0.08f, 10.0f, 0.0f, 0.0f};
    case DetailMaterial::Smoke:
        break;
    }
    return {0.2f, 18.0f, 0.1f, 0.05f};
}

} // namespace

void writeDetail(const FieldDetail& detail, const DetailGenerations& generations, base::SnapshotGroup& io)
{
    const MaterialNumbers numbers = numbersOf(detail.material);
    const std::span<float> constants = io.editConstants();
    constants[constant::Generation] = float(generations.younger % base::kGenerationCycle);
    constants[constant::Fade] = float(generations.fade);
    for (size_t g = 0; g < 2; ++g) {
        constants[constant::Length0 + g] = kLumpsPerRadius * detail.billowSize * generations.radius[g];
        constants[constant::Growth0 + g] = generations.radius[g] / generations.radiusNow[g];
    }
    constants[constant::Thinnest] = numbers.thinnest;
    constants[constant::Densest] = numbers.densest;
    constants[constant::Ramp] = 0.45f - 0.4f * detail.crispness;
    constants[constant::Gain] = 0.35f + 0.4f * detail.raggedness;
    constants[constant::Cooling] = numbers.cooling;
    constants[constant::Glow] = numbers.glow;
    constants[constant::Softening] = detail.softening;
    constants[constant::Lossy] = 0.0f;
}

base::SnapshotGroup& addMaterial(const FieldDetail& detail, const DetailGenerations& generations,
                                 base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot)
{
    base::SnapshotGroup& group = snapshot.addGroup(kind, capacity);
    base::GroupInfo& info = group.editInfo();
    info = snapshot.editGroup(snapshot.addedCount() - 2).info();
    info.kind = kind;
    writeDetail(detail, generations, group);
    return group;
}

} // namespace fx::sim
