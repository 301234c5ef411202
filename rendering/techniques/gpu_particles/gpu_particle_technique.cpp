#include "rendering/techniques/draw_techniques.h"

#include "rendering/particle_rows/row_technique.h"
#include "rendering/techniques/rows/row_view.h"

namespace fx::render {

namespace {

bool isThere(const base::SnapshotGroup& group)
{
    return group.program() && !group.info().bounds.empty();
}

BatchShape shapeOf(const base::SnapshotGroup& group)
{
    const bool isMesh = group.constants()[base::particle_constant::Shape] == float(base::ParticleShape::Mesh);
    return isMesh ? BatchShape::Mesh : BatchShape::Sprite;
}

uint32_t rowsOf(const base::SnapshotGroup& group)
{
    return group.program()->rows;
}

/// Rows are not known before they are computed: all count as in the middle of where they can be.
RowCard meanCard(const base::SnapshotGroup& group, size_t)
{
    const base::GpuParticleProgram& program = *group.program();
    const float aspect = group.constants()[base::particle_constant::Aspect];
    const base::Bounds& bounds = group.info().bounds;
    const glm::vec3 middle = bounds.empty() ? glm::vec3(0.0f) : 0.5f * (bounds.min + bounds.max);
    return {middle, 4.0f * program.meanRadius * program.meanRadius * aspect};
}

base::Bounds boundsOf(const base::SnapshotGroup& group)
{
    return group.info().bounds;
}

constexpr RowTechnique kRows{&base::kGpuParticleKind,
                             false,
                             true,
                             base::kParticleColumns,
                             ~base::particle_column::kIndex,
                             isThere,
                             shapeOf,
                             rowsOf,
                             meanCard,
                             boundsOf};

constexpr TimedPass kPasses[] = {{"gpu particles"}, {"gpu particle order"}};

} // namespace

/// Its programs follow from what emitters publish, see TechniqueView::warmUp(). Rows are drawn by the
/// programs of sprites and meshes.
constexpr DrawTechnique kGpuParticleTechnique{
    .name = "particles on the GPU",
    .kind = &base::kGpuParticleKind,
    .rows = &kRows,
    .create = makeRowView,
    .passes = kPasses,
};

} // namespace fx::render
