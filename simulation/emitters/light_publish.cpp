// What emitters publish besides their particles: trails and lights.
#include "simulation/emitters/emitter_solver.h"
#include "simulation/particles/row_publication.h"

#include <algorithm>

namespace fx::sim {

namespace {
constexpr float kPi = 3.14159265f;
}

bool EmitterSolver::publishTrails(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                  PublicationPlace& place, base::WorkBudget& work) const
{
    if (kinds_.ribbon == base::kNoKind)
        return true;
    if (place.part == 0) {
        base::SnapshotGroup& group = snapshot.addGroup(kinds_.ribbon, trails_->mostPoints());
        group.editInfo() = base;
        group.editInfo().kind = kinds_.ribbon;
        writeConstants(def_, def_.trail.appearance, def_.trail.arcPerTile, group.editConstants());
        group.editConstants()[base::particle_constant::Edge] = def_.trail.edge;
        group.editConstants()[base::particle_constant::TailAge] = def_.trail.lifetime;
    }
    place.part = 1;
    return trails_->publish(now_, base::toTicks(double(snapshot.secondsBack())),
                            snapshot.editGroup(snapshot.addedCount() - 1), place, work);
}

/// A sprite emits its luminance from its projected area; a medium from the smaller of that and its cross
/// section.
EmitterSolver::Light EmitterSolver::lightOf(uint32_t row, uint32_t i, const MotionTile& motion) const
{
    const float life = motion.life[i];
    const bool medium = def_.appearance.kind == AppearanceKind::Medium;
    const auto color = medium ? def_.emissionOverLife.at(life) : def_.appearance.colorOverLife.at(life);
    const float radius = store_.value(stored::Radius, row) * def_.sizeOverLife.at(life)[0];
    const float amount = store_.value(stored::Amount, row) * def_.opacityOverLife.at(life)[0];
    const float area = kPi * radius * radius;
    float strength = medium ? std::min(area, amount) : amount * store_.value(stored::Brightness, row);
    if (!medium)
        strength *= def_.light.intensity > 0.0f ? def_.light.intensity : def_.appearance.luminance * area;
    Light light;
    light.row = row;
    for (int a = 0; a < 3; ++a) {
        light.position[a] = motion.position[a][i];
        light.intensity[a] = strength * color[size_t(a)] * store_.value(stored::TintRed + size_t(a), row);
    }
    light.sum = light.intensity.x + light.intensity.y + light.intensity.z;
    return light;
}

/// Fills lights_ with all particles that shine, by row. @return whether all are found
bool EmitterSolver::findLights(PublicationPlace& place, base::WorkBudget& work) const
{
    const AppearanceJob job = appearanceJob();
    MotionTile motion;
    for (; place.row < job.rows.count; place.row += kTileRows) {
        if (work.isSpent())
            return false;
        const uint32_t rows = std::min(job.rows.count - place.row, kTileRows);
        readMotion(job, place.row, rows, motion);
        for (uint32_t i = 0; i < rows; ++i) {
            const uint32_t row = place.row + i;
            const bool outside = row >= job.rows.gapBegin && row < job.rows.gapEnd;
            if (outside || !store_.isAlive(row, now_))
                continue;
            const Light light = lightOf(row, i, motion);
            if (light.sum > 0.0f)
                lights_[place.count++] = light;
        }
        work.spend(uint64_t(emitter_work::kLight * double(rows)));
    }
    return true;
}

bool EmitterSolver::publishLights(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                  PublicationPlace& place, base::WorkBudget& work) const
{
    if (kinds_.light == base::kNoKind)
        return true;
    if (!findLights(place, work))
        return false;
    uint32_t count = place.count;
    const auto end = lights_.begin() + count;
    if (def_.light.merged && count > 1) {
        Light all;
        for (auto light = lights_.begin(); light != end; ++light) {
            all.intensity += light->intensity;
            all.sum += light->sum;
            all.position += light->sum * light->position;
        }
        all.position /= all.sum;
        lights_[0] = all;
        count = 1;
    } else if (count > def_.light.maxLights) {
        const auto brighter = [](const Light& a, const Light& b) {
            return a.sum != b.sum ? a.sum > b.sum : a.row < b.row;
        };
        count = def_.light.maxLights;
        std::nth_element(lights_.begin(), lights_.begin() + count, end, brighter);
        const auto byRow = [](const Light& a, const Light& b) { return a.row < b.row; };
        std::make_heap(lights_.begin(), lights_.begin() + count, byRow); // heap sort: no allocation
        std::sort_heap(lights_.begin(), lights_.begin() + count, byRow);
    }
    namespace column = base::light_column;
    base::SnapshotGroup& group =
        snapshot.addGroup(kinds_.light, def_.light.merged ? 1 : def_.light.maxLights);
    base::GroupInfo& info = group.editInfo();
    info = base;
    info.kind = kinds_.light;
    info.count = count;
    for (uint32_t i = 0; i < count; ++i)
        for (size_t a = 0; a < 3; ++a) {
            group.editColumn(column::PositionX + a)[i] = lights_[i].position[int(a)];
            group.editColumn(column::IntensityR + a)[i] = lights_[i].intensity[int(a)];
        }
    for (uint32_t i = 0; i < count; ++i)
        info.bounds.add(lights_[i].position, 0.0f);
    return true;
}

} // namespace fx::sim
