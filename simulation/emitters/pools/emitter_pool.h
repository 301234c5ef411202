/// @file emitter_pool.h
/// A pool of small emitters of one definition, which share the rows of one store.
///
/// Rows are in the order of birth over all members. Therefore a pass has full vectors of particles of similar
/// age without empty rows, also for members with few particles. A member without births or deaths in a step
/// has no cost in this step. Results have the same bits as without a pool, because random numbers use the
/// seed of the member and ages are differences of ticks. A birth is dropped if its row in the member's own
/// store would be occupied. Births are also dropped, and counted, if memory for more rows is exhausted.
#pragma once

#include "simulation/emitters/births/birth_schedule.h"
#include "simulation/emitters/pools/pooled_emitter.h"
#include "simulation/particles/birth_kernel.h"
#include "simulation/particles/particle_store.h"
#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::sim {

/// Data of an emitter that is added to a pool.
struct PoolEntry
{
    PooledEmitter* emitter;
    uint32_t user;      ///< number by which the owner of the pool identifies the emitter
    uint64_t seed;      ///< seed of the emitter's instance
    base::Ticks offset; ///< local time of the emitter minus the time of the pool
    EvenBirths births;  ///< local time
    base::Ticks end;    ///< local time after which there are no births
};

/// A pool of emitters. Threads: one at a time (the scene thread). Large publications use the threads of the
/// task runner.
class EmitterPool
{
public:
    /// Creates an empty pool.
    /// @param pull [m/s2] acceleration of all members, see AppearanceJob
    /// @param revision counter that is incremented whenever a member is added or removed
    EmitterPool(std::shared_ptr<const ParticleProgram> program, const glm::vec3& pull, uint64_t& revision,
                std::pmr::memory_resource* memory);

    bool fits(const ParticleProgram& program, const glm::vec3& pull) const;
    uint32_t members() const { return taken_; }
    bool empty() const { return taken_ == 0; }
    base::Ticks now() const { return now_; }
    /// Registers a request to join in step `number`. Returns the number of requests in that step.
    uint32_t offer(uint64_t number)
    {
        offers_ = offered_ == number ? offers_ + 1 : 1;
        offered_ = number;
        return offers_;
    }
    uint64_t offered() const { return offered_; } ///< number of the step of the last offer

    /// Adds an emitter with its particles, at the time `now` of the pool.
    /// @return number of the member; kNoMember, without changes, if memory is exhausted
    uint32_t admit(const PoolEntry& entry, base::Ticks now);
    static constexpr uint32_t kNoMember = ~0u;
    /// Removes a member and its particles.
    void forget(uint32_t member);
    /// Copies the present state of a member into its emitter. The emitter remains a member.
    void write(uint32_t member) const;

    /// Computes all births and deaths up to `to`. Removes members that have no particles, and members that
    /// have no future births.
    /// @param outLeft receives the `user` numbers of removed members
    void step(base::Ticks to, StepCounters& counters, std::vector<uint32_t>& outLeft);
    /// Publishes all members. The number of a member does not change while it is in the pool.
    void publish(base::KindId kind, base::TaskRunner& tasks, base::FrameSnapshot& snapshot) const;

    /// Calls f(emitter, user) for all members; f may remove members.
    template <class F>
    void forEach(F&& f)
    {
        for (size_t m = 0; m < members_.size(); ++m)
            if (members_[m].emitter)
                f(*members_[m].emitter, members_[m].user);
    }
    uint32_t countAlive(uint32_t member) const;
    bool isAnyAlive(uint32_t member) const
    {
        return now_ < members_[member].frontUntil || countAlive(member) > 0;
    }
    const ParticleProgram& program() const { return *program_; }

private:
    struct Member
    {
        PooledEmitter* emitter = nullptr; ///< null: the entry is free
        uint64_t seed = 0;
        EvenBirths births;   ///< births in the time of the pool
        base::Ticks end = 0; ///< time of the pool after which there are no births
        uint64_t next = 0;   ///< birth index
        uint64_t front = 0;  ///< birth index of the oldest living particle
        base::Ticks frontUntil = 0;
        uint32_t nextRow = 0; ///< row of the next birth in the member's own store
        uint32_t frontRow = 0;
        uint32_t rows = 0; ///< number of occupied rows in the member's own store
        uint32_t highWater = 0;
        uint32_t user = 0;
        uint64_t dropped = 0;
        base::Ticks offset = 0; ///< local time of the member minus the time of the pool
    };

    size_t placeOfName(uint32_t name) const { return placeOf(name >> 8, name & 0xFF); }
    size_t placeOf(uint32_t member, uint32_t row) const { return size_t(member) * each_ + row; }
    /// True if the particle with a serial number is alive at `tick`. `outRow` then receives the row of the
    /// particle.
    bool lives(uint64_t serial, base::Ticks tick, uint32_t& outRow) const;
    void makeRoom(uint32_t member, uint64_t rows);
    void rebuild(uint64_t rows);
    void put(uint32_t member, uint64_t particle, uint32_t row, uint64_t serial);
    void takeRows(uint32_t member, const ParticleStore& own);
    void giveBirths(uint32_t member, base::Ticks to, StepCounters& counters);
    bool findRoom();
    void makeBirths();
    void retire(uint32_t member);
    void wakeLater(uint32_t member);
    void nameOwners(base::PooledRows& out) const;

    std::shared_ptr<const ParticleProgram> program_;
    glm::vec3 pull_;
    uint32_t each_; ///< number of rows of the own store of each member
    uint64_t& revision_;
    std::pmr::memory_resource* memory_;
    ParticleStore store_; ///< ring of all births of the pool; the indices of the store are serial numbers
    /// for each row: the member, and the row in the member's own store, see base::PooledRows
    std::vector<uint32_t> owner_;
    std::vector<uint64_t> index_; ///< for each row: birth index of the particle in its member
    /// For each row of each member's own store: serial number of the last particle in that row, or
    /// kNoParticle.
    std::vector<uint64_t> serial_;
    std::vector<base::Ticks> wake_; ///< for each member: first tick at which a step has births or deaths
    std::vector<uint32_t> counts_;  ///< for each member: number of elements of its group
    std::vector<Member> members_;
    std::vector<uint32_t> free_;
    std::vector<uint32_t> due_;
    std::vector<PooledBirth> births_; ///< pending births; the index of the first birth is store_.next()
    uint64_t number_ = 0;             ///< revision of the order of rows, see base::PooledRows::writer
    uint64_t rowsInUse_ = 0;
    uint32_t taken_ = 0; ///< number of members
    base::Ticks now_ = 0;
    uint64_t offered_ = 0;
    uint32_t offers_ = 0;
};

} // namespace fx::sim
