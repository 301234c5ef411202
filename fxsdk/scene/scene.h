/// @file scene.h
/// A scene: the table of all instances, the simulated world of the active instances, and the snapshots for
/// views.
///
/// Threads: one thread at a time (the scene thread); acquire() and release() from any thread.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "foundation/time/step_clock.h"
#include "fxsdk/activation/active_list.h"
#include "fxsdk/activation/budget.h"
#include "fxsdk/activation/focus.h"
#include "fxsdk/activation/sphere_hierarchy.h"
#include "fxsdk/activation/timer_queue.h"
#include "fxsdk/scene/display_rules.h"
#include "fxsdk/scene/event_queue.h"
#include "fxsdk/scene/id_table.h"
#include "fxsdk/scene/motion_history.h"
#include "fxsdk/scene/motion_track.h"
#include "fxsdk/scene/scene_types.h"
#include "simulation/world/world.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace fx::scene {

class Scene
{
public:
    Scene(const SceneOptions& options, const base::SnapshotSchema* schema, base::TaskRunner* tasks,
          std::pmr::memory_resource* memory);

    /// Adds an instance. Strong guarantee, also if memory is exhausted.
    /// @return 0 if the scene is full
    LocalId add(InstanceSetup setup, const DisplayRule& rule = {});
    bool contains(LocalId id) { return instances_.find(id) != nullptr; }

    // If an earlier update has left a step incomplete, changes take effect at the end of the step. A step
    // ends with its publication.

    // The id must name an instance of this scene.
    void remove(LocalId id);
    /// Returns the state of an instance. In lock-step mode, the instance is first caught up. So the result
    /// does not depend on cameras.
    InstanceState state(LocalId id);
    uint32_t particles(LocalId id);
    uint64_t userData(LocalId id) { return instances_.find(id)->setup.userData; }
    void setUserData(LocalId id, uint64_t number) { instances_.find(id)->setup.userData = number; }
    void setPlacement(LocalId id, const base::Placement& placement);
    /// Adds a pose to the path of an instance, which from the next step on stands at each step's end where
    /// the path is at that time. Strong guarantee. setPlacement() ends the motion.
    /// The pose replaces all poses of the instance at its time and after it.
    /// @return Capacity (the instance has as many poses after the present as it can keep)
    base::Status setMotion(LocalId id, const MotionPose& pose);
    void setParameters(LocalId id, const sim::InstanceParameters& parameters);
    const sim::InstanceParameters& parameters(LocalId id) { return instances_.find(id)->setup.parameters; }
    /// @param rate see sim::InstanceClock
    void setRate(LocalId id, uint32_t rate);
    uint32_t rate(LocalId id)
    {
        const InstanceSetup& setup = instances_.find(id)->setup;
        return setup.clock ? setup.clock->rate : setup.rate;
    }
    /// Moves an instance to a local time. The next update() publishes the result, even if the update takes
    /// no step.
    /// @return InvalidArgument before the start and after the end of the instance
    base::Status seek(LocalId id, base::Ticks local);
    /// Triggers the host event `name` of an instance's preset `count` times.
    /// @return NotFound (the preset has no event of this name), InvalidArgument (the instance has not
    ///     started)
    base::Status postEvent(LocalId id, std::string_view name, uint32_t count);
    /// Lets all instances of the effect `from` that have not ended go on with the effect `to`, as if each had
    /// been created with it and moved to its local time by seek(). Identities, placements, seeds, parameters,
    /// hints and masks do not change. Ended instances get the effect and stay ended. An incomplete step is
    /// completed first. Strong guarantee, except for that.
    /// @param to may be equal to `from`
    /// @return number of instances of `from` that have not ended
    uint32_t replace(const sim::EffectDef& from, const std::shared_ptr<const sim::EffectDef>& to,
                     Replacement mode);
    const std::shared_ptr<const sim::EffectDef>& effectOf(LocalId id)
    {
        return instances_.find(id)->setup.effect;
    }
    const base::Placement& placementOf(LocalId id) { return instances_.find(id)->setup.placement; }
    /// [tick] Local time at the present; negative before the start, 0 after the end.
    base::Ticks localTime(LocalId id);
    void setHints(LocalId id, const ActivationHints& hints);
    /// Sets the bits of which a frame needs one to show an instance. Strong guarantee.
    void setVisibilityMask(LocalId id, uint32_t mask) { rules_.setMask(id, mask); }
    uint32_t visibilityMask(LocalId id) const { return rules_.of(id).mask; }
    /// Sets the layer, and the order within it at equal depth. Strong guarantee.
    void setLayer(LocalId id, int32_t layer, int32_t sortKey) { rules_.setOrder(id, layer, sortKey); }
    const DisplayRules& displayRules() const { return rules_; } ///< [any thread]

    /// Keeps the memory of `count` instances of an effect, see fx_reserve.h. Completes an incomplete step.
    /// Otherwise strong guarantee.
    /// @return Capacity (the reservations of the scene would exceed SceneOptions::reserveLimit)
    base::Status reserve(const std::shared_ptr<const sim::EffectDef>& effect, sim::QualityLevel level,
                         uint32_t count);
    struct Reservation
    {
        std::shared_ptr<const sim::EffectDef> effect;
        sim::QualityLevel level = sim::QualityLevel::Medium;
        uint32_t count = 0;
        uint32_t idle = 0;   ///< number of sets of solvers that no simulation uses
        uint64_t bytes = 0;  ///< [byte] estimated memory
        uint64_t misses = 0; ///< number of simulations that found no set
    };
    std::optional<Reservation> reservation(const sim::EffectDef& effect, sim::QualityLevel level) const;
    const std::pmr::vector<Reservation>& reservations() const { return reservations_; } ///< without `misses`
    uint64_t reservedBytes() const
    {
        return reservedBytes_.load(std::memory_order_relaxed);
    } ///< [any thread]

    /// State and estimated cost of an instance.
    struct Activity
    {
        InstanceState state = InstanceState::Finished;
        Reason reason = Reason::None;
        sim::CatchUp policy = sim::CatchUp::Replay;
        base::Ticks lag = 0;     ///< time that has not been simulated yet
        double significance = 0; ///< [pixel] size on the picture, times priority
        double reach = 0;        ///< [m] world; infinite when unknown
        uint32_t particles = 0;
        double milliseconds = 0; ///< estimated time of a step
    };
    Activity activity(LocalId id);

    /// Sets the view frusta, against which instances are tested. Strong guarantee. @param frusta empty:
    /// every instance is in sight
    void setFocus(std::span<const activation::Frustum> frusta);
    void setBudget(const activation::Budget& budget);

    /// Replaces the geometry that effects collide with; null: no geometry. Strong guarantee.
    /// @param cellSize see sim::DistanceField::build
    /// @return the error of sim::DistanceField::build
    base::Status setCollisionMesh(const sim::TriangleMesh* mesh, float cellSize);
    /// Replaces the collision geometry by a field that has already been built.
    void setCollisionField(std::shared_ptr<const sim::DistanceField> field)
    {
        world_.setField(std::move(field));
    }

    /// Sets the contact callback of the host; see sim::World::setContact().
    void setContact(const sim::HostContact& contact)
    {
        completeStep();
        world_.setContact(contact);
    }
    /// Number of invalid results of the contact callback since the last call.
    uint64_t takeContactFaults() { return world_.takeContactFaults(); }
    /// Selects whether particles are computed on the GPU, see sim::World::setGpuParticles.
    void setGpuParticles(bool onGpu) { world_.setGpuParticles(onGpu); }

    /// Advances the scene by dt [s] and publishes the last two steps. If the work budget is used up before
    /// all steps are complete, the next updates continue the steps, and simulated time lags. If memory is
    /// exhausted in a step, the function throws std::bad_alloc after all steps. Then time has advanced, and
    /// instances without memory are missing.
    /// @return false if dt is negative or not finite; the scene then does not change, except for the counter
    ///     of refused updates
    bool update(double dt);

    /// Number of events that takeEvents() can return.
    uint32_t eventCount();
    /// Calls f(event) for the oldest events and removes them.
    /// @param number at most eventCount()
    template <class F>
    void takeEvents(uint32_t number, F&& f)
    {
        if (events_)
            events_->take(number, f);
    }
    uint64_t lostEvents() const { return events_ ? events_->lost() : 0; }

    SceneCounters counters() const;
    uint32_t particles() const; ///< sum over all active instances
    const UpdateCounters& lastUpdate() const { return update_; }
    /// [ns] time of one particle in one step, from the budget or measured.
    double nanosecondsPerParticle() const;
    const base::StepClock& clock() const { return clock_; }
    /// Hash of the published particles and of the time of the last step. The hash does not depend on the
    /// division of time into updates.
    uint64_t stateHash();

    /// Hash of all data that later steps depend on. The hash excludes the remainder of the clock, and so
    /// does not depend on the frame rate. A hidden instance is first caught up, if its catch-up is
    /// bit-identical.
    uint64_t simulationHash();
    /// Writes the state for restore(). Hidden instances are first caught up.
    void save(sim::StateWriter& writer);
    /// Function that returns the effect with a fingerprint, or null if the effect does not exist. restore()
    /// calls the function for effects that no instance of the scene uses.
    using FindEffect = std::function<std::shared_ptr<const sim::EffectDef>(uint64_t fingerprint)>;
    /// Restores a saved state, including identities, and publishes it. Step, gravity, ground and geometry of
    /// the saved scene must equal the values of this scene. Strong guarantee.
    /// @return Parse, NotFound (an effect), InvalidArgument (different step, gravity, ground or geometry),
    ///     Capacity
    base::Status restore(std::span<const std::byte> bytes, const FindEffect& findEffect);
    /// Calls f(id) for each instance, by ascending index.
    template <class F>
    void forEach(F&& f) const
    {
        instances_.forEach([&](uint32_t index, const Instance&) { f(instances_.idAt(index)); });
    }

    /// Enables or disables marks for one view. While a view needs marks, each update() visits all instances
    /// and writes one mark per instance. [any thread]
    /// @param more true: enable
    void wantMarks(bool more) { marksWanted_.fetch_add(more ? 1 : -1); }
    /// Copies the marks of the last update(). [any thread]
    void copyMarks(std::pmr::vector<Mark>& out);

    Presentation acquire();
    /// Does the same, and lists the instances in motion with their placements at the present, ascending by
    /// instance. The placements in the snapshots are those at the ends of steps.
    /// @param outShown memory of SnapshotPair::shown, which must not change before release()
    Presentation acquire(std::pmr::vector<base::ShownPlacement>& outShown);
    /// True while the snapshots of acquire() are empty. [any thread]
    bool showsNothing() const { return showsNothing_.load(std::memory_order_acquire); }
    void release(const base::SnapshotPair& snapshots) { ring_.release(snapshots); }

private:
    struct Instance
    {
        InstanceSetup setup;
        uint64_t serial = 0; ///< order of creation
        sim::Slot slot = 0;  ///< slot in the world, unless dormant or finished
        InstanceState state = InstanceState::Finished;
        Reason reason = Reason::None; ///< reason for being hidden
        sim::CatchUp policy = sim::CatchUp::Replay;
        activation::SphereHierarchy::Leaf leaf = activation::SphereHierarchy::kNone;
        bool hasAlarm = false;
        bool wasResting = false; ///< true: the instance was resting before it began to wake
        /// true: the instance is waking, and its replay exceeded the work of the update in which it began to
        /// wake
        bool isLate = false;
        uint32_t lastParticles = 0; ///< number of particles when the instance was hidden
        ActivationHints hints;
        double reach = 0;     ///< [m] world
        float localReach = 0; ///< [m] reach of the effect in local space, in a wind of reachWind
        /// [m/s] local wind for which localReach was computed; negative: localReach is not valid.
        float reachWind = -1;
        /// extremes of past placements and winds; null: the present values suffice for the bounds
        std::unique_ptr<MotionHistory> past;
    };
    struct Restored;  ///< a state that is being restored
    struct Successor; ///< an instance with its next effect
    class Succession; ///< all successors of a call of replace()

    void wake(base::Ticks until);
    void enterWorld(uint32_t index);
    struct Seek
    {
        LocalId id;
        base::Ticks to; ///< local time
    };
    inline void takeSteps(const base::StepPlan& plan);
    inline bool isAtRest(base::Ticks until) const;
    inline void passSteps(uint32_t steps);
    void prepareSteps(const base::StepPlan& plan);
    void postpone(uint32_t steps);
    void countDropped(base::Ticks ticks);
    inline void beginStep(base::Ticks from, bool isLast);
    inline void endStep(base::Ticks to);
    inline bool proceed();
    bool isShort() const;
    base::WorkBudget lateWork() const;
    void completeStep();
    void makeChanges();
    void letArrive();
    void wait(uint32_t index);
    Successor successorOf(uint32_t index, const std::shared_ptr<const sim::EffectDef>& effect,
                          Replacement mode) const;
    void succeed(Successor& successor);
    /// Tick from which a present change takes effect.
    base::Ticks present() const
    {
        return clock_.simulated() + (world_.isStepping() ? clock_.stepTicks() : 0);
    }
    void moveOn(uint32_t step, uint32_t steps);
    /// An instance and its path.
    struct InMotion
    {
        LocalId id;
        std::unique_ptr<MotionTrack> track;
    };
    std::pmr::vector<InMotion>::iterator inMotion(LocalId id);
    void beginMotion(LocalId id, const Instance& instance, const MotionPose& pose);
    void endMotion(LocalId id);
    void followMotions(base::Ticks to);
    void placeAt(LocalId id, Instance& instance, const base::Placement& placement);
    void saveMotions(sim::StateWriter& writer) const;
    void restoreMotions(sim::StateReader& reader, Restored& state) const;
    void reserveLists(size_t more);
    void reserveLists(Restored& state);
    void addSnapshotRoom(base::FrameSnapshot& snapshot, const sim::EffectDef& effect, sim::QualityLevel level,
                         uint32_t count) const;
    void renewSnapshotRoom();
    void endMoves(bool isComplete);
    void retireFinished(base::Ticks now);
    void recordEvents();
    void finish(uint32_t index);
    void countHints(const Instance& instance, int more);

    // visibility
    bool mayHide(const Instance& instance) const;
    activation::Ball ballOf(const Instance& instance) const;
    double significanceOf(const Instance& instance) const;
    uint64_t particlesOf(const Instance& instance) const;
    void measure(Instance& instance) const; ///< updates the bounds
    BoundsInputs boundsInputsOf(const InstanceSetup& setup, const sim::Influence& influence) const;
    BoundsInputs pastOf(Instance& instance, bool stays, const sim::Influence& influence) const;
    Reason judge(const Instance& instance, bool isSeen);
    void reconsider(const base::StepPlan& plan);
    void updateVisibility();
    void lookAtDenied();
    void keepBudget();
    bool sendOut(uint32_t index, Reason reason);
    void place(uint32_t index, Reason reason);
    void takeBack(uint32_t index);
    void comeBack(uint32_t index);
    void catchUpWaking(base::WorkBudget& work);
    bool catchUp(uint32_t index, uint64_t& ioBudget, base::WorkBudget& work);
    void becomePresent(uint32_t index);
    void ringAlarms(base::Ticks until);
    void setAlarm(uint32_t index, base::Ticks tick);
    void restOrNot(base::Ticks now);
    void settle(bool alsoInexact);
    void forgetSight(); ///< makes every instance active, after restore()
    std::vector<sim::Slot> slotsBySerial() const;
    void settleOne(uint32_t index, bool alsoInexact);
    base::Ticks endOf(const Instance& instance) const;
    void measureTime(double seconds, uint64_t particleSteps);
    void leaveMarks();

    void beginPublication(base::Ticks tick, double interpolation);
    bool proceedPublication(base::Ticks tick, double interpolation);
    void stageReturned(base::Ticks tick);
    void showSought();
    void heedSought(const base::StepPlan& plan);
    /// Sets the time that views show. The caller must hold the mutex presentation_, unless no particle is
    /// visible.
    void show(base::Ticks newest, double interpolation);
    static sim::InstanceStart startOf(const IdTable<Instance>& instances, uint32_t index);

    using Effects = std::vector<std::shared_ptr<const sim::EffectDef>>;
    Effects effects() const; ///< distinct effects, in the order of first use
    static size_t placeOf(const Effects& effects, const sim::EffectDef& wanted);
    void saveRules(sim::StateWriter& writer) const;
    void saveInstances(sim::StateWriter& writer) const;
    void saveDisplayRules(sim::StateWriter& writer) const;
    void saveUserData(sim::StateWriter& writer) const;
    static void restoreUserData(sim::StateReader& reader, Restored& state);
    void restoreDisplayRules(sim::StateReader& reader, Restored& state) const;
    void checkRules(sim::StateReader& reader) const;
    Effects restoreEffects(sim::StateReader& reader, const FindEffect& findEffect) const;
    base::ClockState restoreClock(sim::StateReader& reader) const;
    void restoreInstances(sim::StateReader& reader, const Effects& effects, Restored& state) const;
    void restoreWorld(sim::StateReader& reader, Restored& state) const;
    void take(Restored& state);

    const SceneOptions options_;
    const base::SnapshotSchema* schema_;
    base::TaskRunner* tasks_;
    std::pmr::memory_resource* memory_;
    base::StepClock clock_;
    sim::World world_;
    IdTable<Instance> instances_;
    activation::TimerQueue dormant_;
    activation::ActiveList active_;
    activation::ActiveList waking_;
    activation::ActiveList denied_;    ///< instances in sight, beyond the budget
    activation::ActiveList coarse_;    ///< instances that are hidden and stepped coarsely
    activation::SphereHierarchy tree_; ///< instances that are hidden because of their position
    activation::TimerQueue alarms_;    ///< wake-up times of hidden and resting instances
    activation::FocusSet focus_;
    activation::Budget budget_;
    std::pmr::vector<activation::Candidate> candidates_; ///< scratch
    /// instances in the world whose past is not simulated yet
    std::pmr::vector<LocalId> arrived_;
    std::pmr::vector<Seek> seeks_; ///< seeks requested during an incomplete step
    base::WorkBudget work_;        ///< budget of the present update
    uint64_t stepWork_ = 0;        ///< [unit of base::WorkBudget] work spent on the incomplete step
    /// [unit of base::WorkBudget] work of the present publication, or of the last publication if none is in
    /// progress
    uint64_t shownWork_ = 0;
    base::Ticks published_ = 0;        ///< scene time of the last publication
    base::Ticks stepEnd_ = 0;          ///< scene time at which the last step that has begun ends
    std::optional<EventQueue> events_; ///< empty: no events are recorded
    /// ids of all instances whose InstanceSetup::cameFrom is set; may contain additional ids
    std::pmr::vector<LocalId> moved_;
    /// Instances in motion, ascending by id. Other threads read the list with the mutex presentation_, so
    /// that the scene thread changes it only with the mutex.
    std::pmr::vector<InMotion> motions_;
    std::pmr::vector<Reservation> reservations_;
    std::atomic<uint64_t> reservedBytes_{0};
    bool visibilityStale_ = false; ///< true: an instance or a camera has moved since visibility was tested
    bool memoryFailed_ = false;
    bool sought_ = false; ///< true: the result of a seek() is not published yet
    /// true: instances have another effect than in the last published step, which views must not
    /// interpolate from
    bool replaced_ = false;
    /// true: an instance has entered the world since the last step whose elements views interpolate from its
    /// start on, see sim::SolverDef::startsInMotion()
    bool hasStarted_ = false;
    UpdateCounters update_;
    /// Number of empty publications after which a further empty publication has no effect.
    static constexpr uint32_t kMaxEmptyPublications = 2;
    /// number of consecutive empty publications, counted up to kMaxEmptyPublications + 1
    uint32_t emptyPublications_ = 0;
    uint32_t hidden_ = 0;
    uint32_t resting_ = 0;
    double measuredNanoseconds_ =
        100; ///< [ns] time of one particle in one step; an estimate until the first step
    base::SnapshotRing ring_;
    DisplayRules rules_;
    SceneCounters counters_;
    uint64_t nextSerial_ = 0;

    /// guards the publication and the following members, so that acquire() reads consistent values
    std::mutex presentation_;
    std::atomic<double> interpolation_{0}; ///< changed without the mutex while no particle is visible
    /// [s] scene time of the picture; changed without the mutex while no particle is visible
    std::atomic<double> shownTime_{0};
    std::atomic<bool> showsNothing_{false};
    sim::HintCounts preferring_; ///< for each drawing hint, number of instances that have not ended
    std::atomic<sim::DrawingHints> hints_{sim::DrawingHints()};
    std::pmr::vector<Mark> marks_;
    std::pmr::vector<Mark> newMarks_; ///< marks of the update in progress, written by the scene thread
    std::atomic<int> marksWanted_{0};
};

} // namespace fx::scene
