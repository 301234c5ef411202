/// @file gpu_fixture.h
/// Computes the same effect on the CPU and on the GPU.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/snapshot/gpu_particles.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gpu_particles/gpu_emitters.h"
#include "rendering/gpu_particles/gpu_states.h"
#include "simulation/world/world.h"
#include "tests/rendering/view/view_fixture.h"

#include <memory>
#include <string>
#include <vector>

namespace fx::test {

/// Text of a library preset in which all emitters have the member `compute`.
std::string libraryText(const std::string& name, const char* compute);
std::vector<std::string> libraryNames();

/// A world with one instance of an effect, and its last snapshot.
class OneEffect
{
public:
    /// Creates the world.
    /// @param onGpu true: emitters are published for the GPU where possible
    OneEffect(const base::SnapshotSchema& schema, std::shared_ptr<const sim::EffectDef> effect, bool onGpu,
              uint64_t seed = 7, const base::Placement& place = {});

    void playTo(double seconds, double step = 1.0 / 60.0);
    void seekTo(double seconds);
    const base::FrameSnapshot& publish();
    const base::FrameSnapshot& publishedLast() const { return *snapshot_; }
    /// The second-last snapshot.
    const base::FrameSnapshot* older() const { return older_.get(); }
    sim::World& world() { return world_; }
    sim::Slot slot() const { return slot_; }

    static constexpr base::Ticks kStep = base::kTicksPerSecond / 60;

private:
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    const base::SnapshotSchema& schema_;
    sim::World world_;
    sim::Slot slot_;
    base::Ticks now_ = 0;
    uint64_t sequence_ = 0;
    std::unique_ptr<base::FrameSnapshot> snapshot_, older_;
};

/// Rows of particles of one group, stored as columns. The color has four numbers.
struct Rows
{
    /// columns, indexed by base::particle_column; a column is empty if the group does not have it
    std::vector<std::vector<float>> columns;
    std::vector<glm::vec4> color;
    size_t count() const { return columns[0].size(); }
    bool isAlive(size_t row) const { return columns[base::particle_column::Radius][row] > 0.0f; }
};

Rows rowsOf(const base::SnapshotGroup& group);

class GpuParticleTest : public ViewTest
{
protected:
    void SetUp() override;
    void TearDown() override;

    std::shared_ptr<const sim::EffectDef> load(const std::string& text);
    /// Computes the rows of a group of the kind "gpuParticle" on the GPU.
    Rows computed(const base::SnapshotGroup& group) { return computed(group, *states_); }
    Rows computed(const base::SnapshotGroup& group, render::GpuStates& states);
    std::unique_ptr<render::GpuStates> makeStates()
    {
        return std::make_unique<render::GpuStates>(*device_, std::pmr::get_default_resource());
    }
    /// The picture at the middle time between two steps.
    Picture draw(const base::FrameSnapshot& newer, const base::FrameSnapshot* older);
    base::Status drawInto(const base::FrameSnapshot& newer, const base::FrameSnapshot* older);

    /// The depth texture of setDepth(), imported into the graph of this frame.
    render::GpuDepth seenDepth();

    base::AssetTable assets_{std::pmr::get_default_resource()};

    std::unique_ptr<render::FrameGraph> graph_;
    std::unique_ptr<render::GlBackend> backend_;
    std::unique_ptr<render::GpuEmitters> emitters_;
    std::unique_ptr<render::GpuStates> states_;
    uint32_t steps_ = 0; ///< number of steps that the last call of computed() executed
    /// Camera of the depth texture passed to setDepth(). computed() and draw() use it. Empty: no depth
    /// texture.
    std::optional<render::CameraView> depthCamera_;
};

} // namespace fx::test
