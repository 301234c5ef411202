/// @file run_pool.h
/// The simulations behind the instances of a world. Instances that must come out alike share one run; a run
/// is divided by copying its state as soon as one of its instances is to differ.
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/effect_def.h"

#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::sim {

/// Everything that decides what a run computes, as its solvers see it. Position and scale are not in it, nor
/// is a rotation that leaves gravity and wind as they are, unless the run meets the host's geometry.
struct RunConditions
{
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< scene time of local tick 0
    Quality quality;
    glm::vec3 gravity{0.0f};              ///< [m/s2] local
    glm::vec3 wind{0.0f};                 ///< [m/s] local, the effect's and the host's
    float groundHeight = 0;               ///< [m] local y; -infinity for none
    InstanceParameters parameters;        ///< intensity and emission; its wind is 0, being part of `wind`
    const DistanceField* field = nullptr; ///< the host's geometry; null for none
    base::Placement placement;            ///< in that geometry; default without

    /// Bit for bit.
    bool equals(const RunConditions& other) const;
    uint64_t hash() const;
};

/// The solvers of one effect and what they are told.
struct Run
{
    std::shared_ptr<const EffectDef> effect;
    RunConditions conditions;
    std::vector<std::unique_ptr<Solver>> solvers;
    uint32_t users = 0;     ///< instances that it stands for; 0: unused
    bool fresh = false;     ///< no step has touched it: another instance may still join
    uint32_t nextFresh = 0; ///< see RunPool

    // of one step of the world
    uint64_t visitedIn = 0; ///< number of the last step that had it in its list
    uint64_t steppedIn = 0; ///< number of the last step that stepped it
    uint64_t dividedIn = 0; ///< number of the last step that had only some of its users
    uint32_t visits = 0;    ///< users in the list of that step
    uint32_t division = 0;  ///< run of those users

    void save(StateWriter& writer) const;
    void restore(StateReader& reader);
};

using RunIndex = uint32_t;
constexpr RunIndex kNoRun = ~0u;

class RunPool
{
public:
    /// @param share false: every instance has a run of its own
    RunPool(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory, bool share);

    Run& at(RunIndex index) { return runs_[index]; }
    const Run& at(RunIndex index) const { return runs_[index]; }
    uint32_t count() const { return count_; }    ///< runs in use
    size_t size() const { return runs_.size(); } ///< one more than the largest index

    // What makes solvers may throw std::bad_alloc; then nothing has changed.

    /// One more instance: joins a fresh run that is equal, or starts one.
    RunIndex enter(const std::shared_ptr<const EffectDef>& effect, const RunConditions& conditions);
    /// A run with no users yet, which nobody joins before welcome().
    RunIndex create(const std::shared_ptr<const EffectDef>& effect, const RunConditions& conditions);
    /// A copy of a run, with its state and one user.
    RunIndex copy(RunIndex index);
    /// All users of a run are to have other conditions from now on. Never fails.
    void reset(RunIndex index, const RunConditions& conditions);
    /// One user of a run is to have other conditions from now on. @return the run it then belongs to
    RunIndex change(RunIndex index, const RunConditions& conditions);
    /// One user fewer; the last one takes the solvers with it.
    void leave(RunIndex index);
    /// The run is stepped: it is no longer fresh.
    void touch(RunIndex index);
    /// A fresh run may be joined from now on.
    void welcome(RunIndex index);

    void swap(RunPool& other) noexcept;

private:
    static constexpr size_t kChains = 256;
    uint32_t& chainOf(const Run& run) { return chains_[run.conditions.hash() % kChains]; }
    RunIndex findFresh(const EffectDef* effect, const RunConditions& conditions) const;
    void unlink(RunIndex index);

    const base::SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    bool share_;
    std::vector<Run> runs_;
    std::vector<RunIndex> free_;
    std::array<RunIndex, kChains> chains_; ///< first fresh run of each hash; Run::nextFresh is the next
    uint32_t count_ = 0;
};

} // namespace fx::sim
