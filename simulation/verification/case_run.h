/// @file case_run.h
/// Runs a verification case and measures it.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "simulation/verification/gas_case.h"

#include <functional>

namespace fx::sim {

struct CaseReport
{
    CaseMeasures measures;
    uint32_t particles = 0;
    double seconds = 0;     ///< [s] simulated time
    double energyStart = 0; ///< [J]
    /// [1] Change of the total energy from the start to the end, divided by the initial energy.
    double energyDrift = 0;
    /// [1] Magnitude of the change of the total momentum, divided by the sum of mass times speed. Not
    /// measured if there are walls.
    double momentumDrift = 0;
    AdvanceReport work;         ///< total of all steps
    double initialSeconds = 0;  ///< [s] wall time before the first step
    double steppingSeconds = 0; ///< [s] wall time of the steps, without sampling
    uint64_t hash = 0;          ///< hash of the state at the end
    std::vector<ProfilePoint> profile;
};

struct CaseWatch
{
    /// Callback before each sample, with the index of the sample and the number of samples.
    std::function<void(uint32_t sample, uint32_t samples)> progress;
    /// Callback that is called often. If it returns true, the run ends as soon as possible with
    /// Code::Interrupted.
    std::function<bool()> stop;
};

/// Runs a case to its end and measures it.
/// @tparam T precision of the dynamics
template <class T>
base::Result<CaseReport> runCase(GasCase& gasCase, base::TaskRunner& tasks, const CaseWatch& watch = {});

extern template base::Result<CaseReport> runCase<float>(GasCase&, base::TaskRunner&, const CaseWatch&);
extern template base::Result<CaseReport> runCase<double>(GasCase&, base::TaskRunner&, const CaseWatch&);

} // namespace fx::sim
