/// @file gas_solver.h
/// Solver of one gas of one instance.
#pragma once

#include "simulation/gas/gas_air.h"
#include "simulation/gas/gas_def.h"
#include "simulation/gas/gas_detail.h"
#include "simulation/gas/gas_parcels.h"
#include "simulation/solver/air_mover.h"
#include "simulation/solver/budgeted_solver.h"
#include "simulation/sph/dynamics/gas_dynamics.h"

#include <optional>

namespace fx::sim {

/// Maximum number of sub-steps between two exchanges with the air. The time that needs more sub-steps is not
/// simulated and is reported as debt.
constexpr uint32_t kMaxGasSubSteps = 400;
constexpr double kMaxGasSlices = 64.0; ///< maximum number of exchanges with the air in a step
constexpr double kGasCourant = 0.6;

// [unit] of base::WorkBudget, per particle
constexpr uint64_t kGasReleaseWork = 200;
constexpr uint64_t kGasExchangeWork = 80;
constexpr uint64_t kGasShownWork = 12;
constexpr uint64_t kGasBytes = 1500; ///< [byte] approximate memory per particle, including neighbor lists

/// [m] Support radius with which a particle has `neighbors` neighbors, for `particles` particles in a ball of
/// `radius` [m].
double evenSupport(double radius, uint32_t particles, double neighbors);

/// Alternates gas dynamics and exchanges with the air. An exchange takes place when the cloud has moved by a
/// third of its size, and at least once in every step.
class GasSolver final : public Solver, public BudgetedSolver, public AirMover
{
public:
    /// Creates a solver.
    /// @param def definition; must outlive the solver
    /// @param kind kind of the groups of the gas
    /// @param material kind of the groups with coordinates for detail
    GasSolver(const GasDef& def, const Quality& quality, base::KindId kind, base::KindId material,
              std::pmr::memory_resource* memory);

    void step(const StepContext& context) override
    {
        base::WorkBudget unlimited;
        proceed(context, unlimited);
    }
    bool proceed(const StepContext& context, base::WorkBudget& work) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    /// Publishes the whole gas in one call and ignores the budget.
    bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                            PublicationPlace& /*ioPlace*/, base::WorkBudget& work) const override
    {
        publish(base, snapshot);
        work.spend(kGasShownWork * elementCount());
        return true;
    }
    bool finished(base::Ticks) const override { return done_; }
    uint32_t elementCount() const override { return done_ ? 0 : gas_.count(); }
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;
    BudgetedSolver* budgeted() override { return this; }
    const AirMover* airMover() const override { return this; }
    ThermalFlow thermal(const glm::vec3& gravity, const glm::vec3& wind) const override;

private:
    /// State of a step that is computed over several calls of proceed().
    struct Open
    {
        base::Ticks tick = -1; ///< local time at which the open step begins; -1: no step is open
        double seconds = 0;    ///< [s] length of the step
        double left = 0;       ///< [s] remaining time, from the beginning of the current slice
        /// [s] duration of gas dynamics between two exchanges with the air; 0 between slices
        double slice = 0;
    };
    bool waitsForRelease(const StepContext& context, const base::WorkBudget& work) const;
    bool begin(const StepContext& context, base::WorkBudget& work);
    bool release(const StepContext& context);
    std::span<glm::vec3> ways(const StepContext& context);
    /// Speeds of the gas [m/s].
    struct FlowSpeeds
    {
        double flow;         ///< [m/s] root mean square speed of the flow
        double sound;        ///< [m/s] speed of sound of the hottest gas
        double reducedSound; ///< [m/s] speed of sound of the hottest gas after the reduction by
                             ///< GasDef::soundSpeed
    };
    FlowSpeeds speedsOf(const StepContext& context, const ThermalFlow& thermal) const;
    double exchange(const StepContext& context, double longest, double shortest);
    void takeIn(double pressureScale, base::TaskRunner& tasks);
    /// Corrects the paths of parcels that hit the geometry in a step.
    /// @param before [m] positions of parcels at the beginning of their paths, by id; empty without geometry
    void settle(const StepContext& context, float seconds, std::span<const glm::vec3> before);
    void retireWhenDissolved();
    void writeMotion(class BlobWriter& writer) const;
    void writeAppearance(class BlobWriter& writer) const;

    const GasDef& def_;
    Quality quality_;
    base::KindId kind_;
    base::KindId material_;
    ChargePlan plan_; ///< plan of the charge, computed from the energy of the definition
    GasThermodynamics thermodynamics_;
    uint32_t particles_;
    GasDynamics<float> gas_;
    GasParcels parcels_;
    std::optional<GasDetail> detail_;   ///< present if the preset defines detail of the field
    base::Column<GasParticle> scratch_; ///< scratch for the release
    std::pmr::memory_resource* memory_;
    /// [m] position of each parcel at the beginning of its path; allocated only if the gas collides
    base::Column<glm::vec3> ways_;
    Open open_;
    std::vector<std::byte> unreleased_; ///< state of gas_ before the release
    float hottest_ = 0;                 ///< [K] temperature of the hottest parcel at the end of the last step
    base::Ticks released_;              ///< local time of the release
    base::Ticks now_ = 0;               ///< local time at which the last step ended
    bool begun_ = false;
    bool done_ = false;
};

} // namespace fx::sim
