#include "particle_fixture.h"

#include "rendering/frame/exposure.h"

#include <glm/gtc/packing.hpp>

namespace fx::test {

namespace constant = base::particle_constant;

uint64_t packColor(const glm::vec4& color)
{
    return glm::packHalf4x16(color);
}

render::CameraView flatCamera(float aspect)
{
    return render::orthographicView({{0, 0, 10}, {0, 0, 0}}, 10.0f, aspect, 0.1f, 100.0f);
}

void ParticleTest::SetUp()
{
    ViewTest::SetUp();
    schema_.add(base::kParticleKind);
    schema_.add(base::kRibbonKind);
    view_->setAssets(&assets_);
}

base::FrameSnapshot ParticleTest::emptySnapshot(double seconds)
{
    base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
    snapshot.begin(base::Ticks(seconds * double(base::kTicksPerSecond)), ++sequence_);
    nextSolver_ = 100;
    return snapshot;
}

namespace {

void setDefaults(base::SnapshotGroup& group, uint32_t count, uint32_t solver, float exposure)
{
    group.editInfo().count = count;
    group.editInfo().solver = solver;
    for (float& value : group.editConstants())
        value = 0.0f;
    set(group, constant::AxisY, 1.0f);
    for (const size_t one : {size_t(constant::Aspect), size_t(constant::TileColumns),
                             size_t(constant::TileRows), size_t(constant::ArcPerTile)})
        set(group, one, 1.0f);
    set(group, constant::Layer, 1.0f);
    set(group, constant::Luminance, 1.0f / exposure);
}

} // namespace

base::SnapshotGroup& ParticleTest::addParticles(base::FrameSnapshot& snapshot,
                                                const std::vector<TestParticle>& particles,
                                                base::ColumnSet columns)
{
    namespace column = base::particle_column;
    auto& group = snapshot.addGroup(schema_.find("particle"), particles.size(), columns);
    for (size_t i = 0; i < particles.size(); ++i) {
        const TestParticle& p = particles[i];
        const float values[] = {
            p.center.x, p.center.y,      p.center.z,      p.age,           p.radius,
            0.0f,       p.velocity.x,    p.velocity.y,    p.velocity.z,    p.angle,
            p.frame,    p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w};
        for (size_t c = 0; c < std::size(values); ++c)
            if (c != column::Color && group.has(c))
                group.editColumn(c)[i] = values[c];
        group.editColumn64(column::Color)[i] = packColor(p.color);
        if (group.has(column::Index))
            group.editColumn64(column::Index)[i] = i;
    }
    setDefaults(group, uint32_t(particles.size()), nextSolver_++, render::exposureFromEv100(kEv100));
    return group;
}

base::SnapshotGroup& ParticleTest::addRibbon(base::FrameSnapshot& snapshot,
                                             const std::vector<TestPoint>& points)
{
    namespace column = base::ribbon_column;
    auto& group = snapshot.addGroup(schema_.find("ribbon"), points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        const TestPoint& p = points[i];
        for (size_t k = 0; k < 3; ++k)
            group.editColumn(column::PositionX + k)[i] = p.center[int(k)];
        group.editColumn(column::HalfWidth)[i] = p.halfWidth;
        group.editColumn(column::Arc)[i] = p.arc;
        group.editColumn64(column::Color)[i] = packColor(p.color);
        group.editColumn64(column::Strip)[i] = p.strip;
        group.editColumn(column::Age)[i] = p.age;
    }
    setDefaults(group, uint32_t(points.size()), nextSolver_++, render::exposureFromEv100(kEv100));
    return group;
}

Picture ParticleTest::renderPair(const base::FrameSnapshot& newer, const base::FrameSnapshot* older,
                                 double interpolation, const render::CameraView& camera)
{
    render::FrameRequest request;
    request.camera = camera;
    request.targets.color = color_->name();
    request.targets.depth = useDepth_ ? depth_->name() : 0;
    request.targets.width = color_->width();
    request.targets.height = color_->height();
    request.interpolation = interpolation;
    const base::SnapshotPair pair{&newer, older};
    const base::Status status = view_->render(pair, request);
    EXPECT_TRUE(status.ok()) << status.message();
    return read(color_->name());
}

} // namespace fx::test
