#include "simulation/gas/gas_solver.h"

#include "foundation/math/elementary.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/gas/gas_exchange.h"
#include "simulation/gas/gas_release.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fx::sim {

namespace {

constexpr uint32_t kMinBatch = 128;        ///< particles
constexpr float kGroundClearance = 0.15f;  ///< [1] of the support between the ground and a center
constexpr float kGroundRestitution = 0.1f; ///< [1] also of the host's geometry
constexpr double kLargestGrowth = 4.0;     ///< [1] largest support over that of an even fireball

constexpr double kShift = 0.8;         ///< [1] strength of particle-shifting
constexpr double kLongestShift = 0.06; ///< [1] of a spacing, between two exchanges with the air
constexpr double kNudge = 1.25; ///< [1] change of the pressure scale that waits for the next evaluation

void count(const AdvanceReport& report, StepCounters& counters)
{
    counters.subSteps += report.subSteps;
    counters.particleSteps += report.particleSteps;
    counters.neighborPairs += report.pairs / 2;
    counters.clamped += report.clamped;
    counters.debt += base::toTicks(report.debt);
}

uint32_t particlesOf(const GasDef& def, const Quality& quality)
{
    const double wanted = std::ceil(double(def.particles) * double(quality.particles));
    return uint32_t(std::clamp(wanted, 1.0, 1e6));
}

/// Where each parcel is, by id.
void rememberPlaces(const GasView<float>& view, std::span<glm::vec3> outPlaces)
{
    for (uint32_t i = 0; i < view.count; ++i)
        outPlaces[view.id[i]] = {view.x[i], view.y[i], view.z[i]};
}

/// What the geometry leaves of the way of particle `i`.
void collide(const Collider& collider, const GasView<float>& view, uint32_t i, const glm::vec3& before)
{
    glm::vec3 position(view.x[i], view.y[i], view.z[i]);
    glm::vec3 velocity(view.vx[i], view.vy[i], view.vz[i]);
    const SurfaceResponse response{kGroundClearance * view.support[i], kGroundRestitution, 0.0f};
    if (!collider.settle(before, position, velocity, response))
        return;
    view.x[i] = position.x;
    view.y[i] = position.y;
    view.z[i] = position.z;
    view.vx[i] = velocity.x;
    view.vy[i] = velocity.y;
    view.vz[i] = velocity.z;
}

GasDynamicsDef dynamicsOf(const GasDef& def, const ChargePlan& plan, const Quality& quality)
{
    const uint32_t count = particlesOf(def, quality);
    GasDynamicsDef dynamics;
    dynamics.capacity = count;
    dynamics.neighbors = double(quality.neighbors);
    dynamics.state.gamma = plan.gamma;
    dynamics.viscosity.alphaMax = std::max(double(def.viscosity), dynamics.viscosity.alphaMin);
    dynamics.viscosity.decay = 0.1;        // soon: rolls are to last
    dynamics.viscosity.conductivity = 0.0; // mixing is entrainment's
    dynamics.courant = kGasCourant;
    dynamics.exact = quality.level == QualityLevel::Reference;
    dynamics.volumeChange = 0.5; // a look, not a measurement
    dynamics.maxSubSteps = kMaxGasSubSteps;
    dynamics.smallestSupport =
        std::max(double(quality.radiusFloor), 0.02) * evenSupport(plan.radius, count, dynamics.neighbors);
    dynamics.largestSupport =
        kLargestGrowth *
        evenSupport(0.5 * std::max(plan.fireballDiameter, 2.0 * plan.radius), count, dynamics.neighbors);
    dynamics.ambientPressure = AmbientAir{}.pressure;
    dynamics.tension = 0.0;
    return dynamics;
}

} // namespace

double evenSupport(double radius, uint32_t particles, double neighbors)
{
    return radius * base::cubeRoot(neighbors / double(particles));
}

std::unique_ptr<Solver> GasDef::create(const base::SnapshotSchema& schema, const Quality& quality,
                                       std::pmr::memory_resource* memory) const
{
    return std::make_unique<GasSolver>(*this, quality, schema.find(base::kBlobKind.name),
                                       schema.find(base::kMaterialKind.name), memory);
}

GasSolver::GasSolver(const GasDef& def, const Quality& quality, base::KindId kind, base::KindId material,
                     std::pmr::memory_resource* memory)
    : def_(def), quality_(quality), kind_(kind), material_(material),
      plan_(planCharge(*def.material, def.energy, double(def.pressureRatio))),
      thermodynamics_{plan_.gamma, def.material->gasConstant, AmbientAir{}},
      particles_(particlesOf(def, quality)), gas_(dynamicsOf(def, plan_, quality), memory),
      parcels_(memory, particles_), scratch_(memory, particles_), memory_(memory),
      released_(def.start > 0.0f ? base::toTicks(std::min(double(def.start), 1e9)) : 0)
{
    if (def.detail.given)
        detail_.emplace(def.detail, def.growth, particles_, memory);
    gas_.save(unreleased_);
}

/// Whether the step releases the gas, and what that counts is better spent in the next update.
bool GasSolver::waitsForRelease(const StepContext& context, const base::WorkBudget& work) const
{
    const bool isDue = !begun_ && !done_ && context.tick + context.stepTicks > released_;
    return isDue && work.spent() > 0 && work.left() < particles_ * kGasReleaseWork;
}

/// @return false when there is nothing to be done in the step
bool GasSolver::begin(const StepContext& context, base::WorkBudget& work)
{
    gas_.abandonAdvance(); // of a step that ended in an exception
    open_ = {};
    now_ = context.tick + context.stepTicks;
    if (done_ || now_ <= released_)
        return false;
    if (!begun_) {
        if (!release(context))
            return false;
        work.spend(uint64_t(particles_) * kGasReleaseWork);
    }
    open_.tick = context.tick;
    open_.seconds = open_.left = base::toSeconds(now_ - std::max(context.tick, released_));
    return true;
}

bool GasSolver::proceed(const StepContext& context, base::WorkBudget& work)
{
    if (open_.tick != context.tick && waitsForRelease(context, work))
        return false;
    if (open_.tick != context.tick && !begin(context, work))
        return true;
    const std::span<glm::vec3> before = ways(context);
    while (open_.left > 0.0) {
        if (open_.slice == 0.0) {
            if (work.isSpent())
                return false;
            open_.slice = exchange(context, open_.left, open_.seconds / kMaxGasSlices);
            work.spend(uint64_t(particles_) * kGasExchangeWork);
            if (context.collider)
                rememberPlaces(gas_.view(), before);
            if (work.isSpent())
                return false;
        }
        const base::Result<AdvanceReport> report = gas_.advance(open_.slice, *context.tasks, work);
        if (gas_.isAdvancing())
            return false;
        if (report.ok())
            count(*report, *context.counters);
        settle(context, float(open_.slice), before);
        open_.left = open_.slice < open_.left ? open_.left - open_.slice : 0.0;
        open_.slice = 0.0;
    }
    if (detail_)
        detail_->follow(std::as_const(gas_).view(), open_.seconds, *context.scratch);
    open_ = {};
    retireWhenDissolved();
    return true;
}

/// Room for the place of each parcel, by id; none without geometry.
std::span<glm::vec3> GasSolver::ways(const StepContext& context)
{
    if (!context.collider)
        return {};
    if (ways_.capacity() == 0)
        ways_ = base::Column<glm::vec3>(memory_, particles_);
    return ways_.first(particles_);
}

bool GasSolver::release(const StepContext& context)
{
    if (!context.parameters->emitting) {
        done_ = true;
        return false;
    }
    begun_ = true;
    const double intensity = std::clamp(double(context.parameters->intensity), 0.0, 1e3);
    const ChargePlan plan = planCharge(*def_.material, def_.energy * intensity, double(def_.pressureRatio));
    done_ = !(plan.mass > 0.0) ||
            !releaseGas(def_, plan, context, scratch_.first(particles_), gas_, parcels_).ok();
    if (done_)
        return false;
    hottest_ = float(plan.temperature);
    gas_.initialize(*context.tasks);
    const std::span<glm::vec3> before = ways(context);
    std::fill(before.begin(), before.end(), def_.position); // all ways begin there: none leads through a wall
    settle(context, 0.0f, before);
    if (detail_)
        detail_->begin(std::as_const(gas_).view(), *context.scratch);
    context.counters->born += particles_;
    return true;
}

/// Spreads the particles evenly: less far than any is from geometry, see settle(), so that none gets through.
/// Then exchanges with the air for the time in which the gas moves a third of the cloud's size, at least
/// `shortest`, at most `longest` seconds; returns it.
double GasSolver::exchange(const StepContext& context, double longest, double shortest)
{
    gas_.shift(kShift, kLongestShift, *context.tasks);
    const GasView<float> view = gas_.view();
    const GasAir air(def_, context, thermal(context.gravity, context.wind));
    const FlowSpeeds speeds = speedsOf(context, air.thermal());
    const double crossing = double(air.thermal().radius) / (3.0 * (speeds.flow + speeds.reducedSound));
    const double slice = std::min(std::max(crossing, shortest), longest);

    const GasExchange exchange{def_, context, air, thermodynamics_, hottest_};
    parallelRows(*context.tasks, view.count, kMinBatch, [&](uint32_t begin, uint32_t end) {
        exchangeWithAir(exchange, view, parcels_, float(slice), begin, end);
    });
    const double reduction = speeds.reducedSound / speeds.sound;
    takeIn(reduction * reduction, *context.tasks);
    return slice;
}

ThermalFlow GasSolver::thermal(const glm::vec3& gravity, const glm::vec3& wind) const
{
    return begun_ && !done_ ? measureThermal(gas_.view(), gravity, wind) : ThermalFlow{};
}

/// Lets the gas go on from what the air has made of it.
void GasSolver::takeIn(double scale, base::TaskRunner& tasks)
{
    if (scale < kNudge * gas_.pressureScale() && gas_.pressureScale() < kNudge * scale) {
        gas_.nudged(scale, tasks);
    } else {
        gas_.edited();
        gas_.setPressureScale(scale);
    }
}

/// Sound need not be faster than lets pressure follow the flow, and carry the gas's weight, at the quality's
/// Mach number.
GasSolver::FlowSpeeds GasSolver::speedsOf(const StepContext& context, const ThermalFlow& thermal) const
{
    const GasTotals totals = gas_.totals();
    const double flow = std::sqrt(2.0 * totals.kinetic / std::max(totals.mass, 1e-30));
    const double sound = std::sqrt(plan_.gamma * kAirGasConstant * double(hottest_));
    double limit = def_.soundSpeed > 0.0f ? double(def_.soundSpeed) : sound;
    if (quality_.flowMach > 0.0f) {
        const double weight = 2.0 * std::sqrt(double(glm::length(context.gravity) * thermal.radius));
        limit = std::min(limit, std::max(flow / double(quality_.flowMach), weight));
    }
    return {flow, sound, std::clamp(limit, 1e-3 * sound, sound)};
}

void GasSolver::settle(const StepContext& context, float seconds, std::span<const glm::vec3> before)
{
    const GasView<float> view = gas_.view();
    parallelRows(*context.tasks, view.count, kMinBatch, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            FireParcel& parcel = parcels_.fire[view.id[i]];
            parcel.temperature =
                std::max(thermodynamics_.potentialTemperature(double(view.entropy[i]), parcel.mixing),
                         thermodynamics_.air.temperature);
            const float floor = context.groundHeight + kGroundClearance * view.support[i];
            if (view.y[i] < floor) {
                view.y[i] = floor;
                view.vy[i] = view.vy[i] < 0.0f ? -kGroundRestitution * view.vy[i] : view.vy[i];
            }
            if (context.collider)
                collide(*context.collider, view, i, before[view.id[i]]);
            parcels_.presence[view.id[i]] *=
                float(base::naturalExp(-double(def_.dissipation) * parcel.burnt * double(seconds)));
        }
    });
    hottest_ = 0;
    for (uint32_t id = 0; id < view.count; ++id)
        hottest_ = std::max(hottest_, float(parcels_.fire[id].temperature));
}

void GasSolver::retireWhenDissolved()
{
    const float* const presence = parcels_.presence.data();
    done_ = std::all_of(presence, presence + particles_, [](float p) { return p <= kFaintest; });
}

} // namespace fx::sim
