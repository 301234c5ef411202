#include "simulation/emitters/emitter_solver.h"

#include "simulation/emitters/pools/spawn_batch.h"
#include "simulation/particles/row_publication.h"

namespace fx::sim {

AppearanceJob EmitterSolver::appearanceJob() const
{
    AppearanceJob job;
    fill(job);
    return job;
}

bool EmitterSolver::proceedPublication(const base::GroupInfo& instance, base::FrameSnapshot& snapshot,
                                       PublicationPlace& place, base::WorkBudget& work) const
{
    catchUpWithPool();
    base::GroupInfo base = instance;
    if (space_ && started_) {
        base.placement = space_->home();
        base.staysInWorld = true;
    }
    constexpr uint32_t kGroups = 3;
    for (; place.group < kGroups; place = {place.group + 1})
        if (!publishGroup(base, snapshot, place, work))
            return false;
    return true;
}

bool EmitterSolver::publishGroup(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                 PublicationPlace& place, base::WorkBudget& work) const
{
    if (place.group == 1)
        return !trails_ || publishTrails(base, snapshot, place, work);
    if (place.group == 2)
        return !def_.light.given || publishLights(base, snapshot, place, work);
    if (def_.appearance.kind == AppearanceKind::Medium)
        return publishMedium(base, snapshot, place, work);
    return def_.appearance.kind == AppearanceKind::None || publishParticles(base, snapshot, place, work);
}

bool EmitterSolver::publishParticles(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                     PublicationPlace& place, base::WorkBudget& work) const
{
    if (kinds_.particle == base::kNoKind)
        return true;
    if (gpu_ && gpu_->isOn()) {
        base::GroupInfo info = base;
        info.isCosmetic = true;
        gpu_->publish(info, kinds_.gpuParticle, key_, now_, snapshot);
        return true;
    }
    return publishRows(appearanceJob(), {kinds_.particle, base}, tasks_, snapshot, place, work);
}

bool EmitterSolver::joinPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    SpawnBatch& spawnBatch) const
{
    if (!publishesWithMany_)
        return false;
    catchUpWithPool();
    const uint32_t rows = store_.window().count;
    base::SnapshotGroup& group =
        addRows(program_, store_.capacity(), rows, {kinds_.particle, base}, snapshot);
    if (rows == 0)
        return true;
    store_.fetch();
    AppearanceJob& job = spawnBatch.add(group);
    fill(job);
    job.secondsBack = snapshot.secondsBack();
    return true;
}

} // namespace fx::sim
