#include "simulation/verification/case_run.h"

#include "simulation/verification/flow_errors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory_resource>

namespace fx::sim {
namespace {

struct Stopped
{};

/// Forwards loops, and throws when a stop is requested: a long step calls it again and again.
class WatchedRunner final : public base::TaskRunner
{
public:
    WatchedRunner(base::TaskRunner& inner, const CaseWatch& watch) : inner_(inner), watch_(watch) {}

    void run(uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument) override
    {
        if (watch_.stop && watch_.stop())
            throw Stopped{};
        inner_.run(count, minBatch, body, argument);
    }

private:
    base::TaskRunner& inner_;
    const CaseWatch& watch_;
};

class Stopwatch
{
public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void addWork(AdvanceReport& sum, const AdvanceReport& part)
{
    sum.seconds += part.seconds;
    sum.debt += part.debt;
    sum.subSteps += part.subSteps;
    sum.particleSteps += part.particleSteps;
    sum.pairs += part.pairs;
    sum.searches += part.searches;
    sum.clamped += part.clamped;
}

template <class T>
std::vector<CaseParticle> particlesOf(const GasDynamics<T>& gas)
{
    std::vector<CaseParticle> particles(gas.count());
    for (uint32_t id = 0; id < gas.count(); ++id) {
        const GasParticle p = gas.particle(id);
        particles[id] = {p.position,        p.velocity,         p.mass,
                         gas.densityOf(id), gas.pressureOf(id), gas.supportOf(id)};
    }
    return particles;
}

bool hasWalls(const Domain& domain)
{
    return std::find(domain.axes.begin(), domain.axes.end(), AxisKind::Reflecting) != domain.axes.end();
}

/// The momentum where no walls take it.
void storeDrifts(const GasTotals& start, const GasTotals& end, bool walls, CaseReport& out)
{
    out.energyStart = start.energy();
    out.energyDrift = (end.energy() - start.energy()) / start.energy();
    const double scale = std::fmax(start.momentumScale, end.momentumScale);
    out.momentumDrift = scale > 0 ? glm::length(end.momentum - start.momentum) / scale : 0;
    if (walls)
        out.momentumDrift = kNotMeasured;
}

/// Bounds that hold for every case: what the equations conserve.
template <class T>
void addConservationLimits(const GasCase& gasCase, CaseReport& out)
{
    const double energy = gasCase.energyTolerance();
    out.measures.limits.push_back({"energy_drift", out.energyDrift, -energy, energy});
    const GasDynamicsDef& def = gasCase.dynamics();
    if (hasWalls(def.domain))
        return;
    const double rounding = sizeof(T) == sizeof(double) ? 1e-12 : 1e-5;
    const double momentum = def.steps == StepScheme::Global ? rounding : 1e-3;
    out.measures.limits.push_back({"momentum_drift", out.momentumDrift, 0, momentum});
}

template <class T>
base::Status step(GasCase& gasCase, GasDynamics<T>& gas, base::TaskRunner& tasks, const CaseWatch& watch,
                  CaseReport& out)
{
    const std::vector<double>& samples = gasCase.sampleTimes();
    double time = 0;
    for (size_t k = 0; k < samples.size(); ++k) {
        if (watch.progress)
            watch.progress(uint32_t(k), uint32_t(samples.size()));
        const Stopwatch stopwatch;
        const base::Result<AdvanceReport> work = gas.advance(samples[k] - time, tasks);
        out.steppingSeconds += stopwatch.seconds();
        if (!work)
            return work.status();
        addWork(out.work, *work);
        time = samples[k];
        gasCase.look(time, particlesOf(gas));
    }
    return {};
}

template <class T>
base::Result<CaseReport> run(GasCase& gasCase, base::TaskRunner& tasks, const CaseWatch& watch)
{
    CaseReport out;
    const Stopwatch stopwatch;
    GasDynamics<T> gas(gasCase.dynamics(), std::pmr::get_default_resource());
    if (base::Status status = gas.add(gasCase.particles()); !status)
        return status;
    gas.initialize(tasks);
    out.initialSeconds = stopwatch.seconds();
    out.particles = gas.count();
    const GasTotals start = gas.totals();
    if (base::Status status = step(gasCase, gas, tasks, watch, out); !status)
        return status;
    storeDrifts(start, gas.totals(), hasWalls(gasCase.dynamics().domain), out);
    out.seconds = out.work.seconds;
    out.hash = gas.hash();
    const std::vector<CaseParticle> particles = particlesOf(gas);
    out.profile = profileOf(gasCase, particles);
    out.measures = gasCase.measure(particles);
    addConservationLimits<T>(gasCase, out);
    return out;
}

} // namespace

template <class T>
base::Result<CaseReport> runCase(GasCase& gasCase, base::TaskRunner& tasks, const CaseWatch& watch)
{
    WatchedRunner watched(tasks, watch);
    try {
        return run<T>(gasCase, watched, watch);
    } catch (const Stopped&) {
        return base::Status{base::Code::Interrupted, "interrupted"};
    }
}

template base::Result<CaseReport> runCase<float>(GasCase&, base::TaskRunner&, const CaseWatch&);
template base::Result<CaseReport> runCase<double>(GasCase&, base::TaskRunner&, const CaseWatch&);

} // namespace fx::sim
