/// @file gas_dynamics.h
/// The equations of gas dynamics by smoothed particle hydrodynamics: density by summation with variable
/// support, entropy form, and artificial viscosity with a switch. Time integration is kick-drift-kick, with
/// equal steps for all particles or a hierarchy of steps.
///
/// The code does not depend on presets, pictures or verification cases. Threads: one at a time. Loops run on
/// the given task runner. Results have the same bits for any runner. All memory comes from the given
/// resource, except in save().
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "foundation/tasks/work_budget.h"
#include "simulation/sph/dynamics/state_equation.h"
#include "simulation/sph/neighbors/domain.h"
#include "simulation/sph/pair_loops/sph_kernel.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

template <class T>
struct DynamicsState;

enum class StepScheme : uint8_t
{
    Global, ///< all particles have the smallest step that a particle allows; momentum is conserved to
            ///< rounding
    Block   ///< each particle has its own step, whose length is a power of two of a tick
};

/// State of a particle that is added or read.
struct GasParticle
{
    glm::dvec3 position{0.0}; ///< [m]
    glm::dvec3 velocity{0.0}; ///< [m/s]
    double mass = 0;          ///< [kg] > 0
    double energy = 0;        ///< [J/kg] specific internal energy, >= 0, including the cold curve
};

/// Parameters of the artificial viscosity. The default values for shocks were fitted to the point blast of
/// `fx verify sedov`, see docs/verification.md.
struct ViscosityRules
{
    double alphaMin = 0.05; ///< [1]
    double alphaMax = 0.91; ///< [1]
    double decay =
        0.005;       ///< [1] decay rate of alpha in units of c / h, with the speed of sound c and h = H / 2
    double beta = 2; ///< [1]
    double conductivity = 0.08; ///< [1]
    bool limiter = true;        ///< true: the Balsara limiter reduces the viscosity in shear flows
};

struct GasDynamicsDef
{
    uint32_t capacity = 0; ///< maximum number of particles, 1 .. 2^28
    SphKernel kernel = SphKernel::WendlandC2;
    /// [1] number of neighbors 4/3 pi n H^3, with the number density n and the support H
    double neighbors = 58;
    StateEquation state;
    ViscosityRules viscosity;
    StepScheme steps = StepScheme::Block;
    /// [1] Courant number: step = 2 courant h / v_sig, with h = H / 2 and the signal speed v_sig
    double courant = 0.2;
    double volumeChange = 0.025; ///< [1] largest relative change of volume of a particle in a step
    /// [1] Largest ratio of the steps of neighbors; infinity: no limit (for tests).
    double neighborStepRatio = 4;
    /// True: exact energies. False: less exact energies, but fewer steps and searches, for visual use. Block
    /// steps then ignore the rule for pairs with unequal steps (gas-step). A support that must grow beyond
    /// its list grows further in the next steps.
    bool exact = true;
    /// Maximum number of sub-steps of one advance(), >= 1. Time that needs more sub-steps is reported as
    /// debt.
    uint32_t maxSubSteps = 1u << 30;
    double smallestSupport = 0; ///< [m] lower limit of supports; 0: 1e-4 times the initial median of supports
    double largestSupport =
        1e30; ///< [m] upper limit of supports; 1e30: 200 times the initial median of supports
    Domain domain;
    glm::dvec3 gravity{0.0};    ///< [m/s2]
    double ambientPressure = 0; ///< [Pa] pressure of the surrounding air, which is not simulated
    /// False: no attraction where the pressure is below the ambient pressure. Use false for a cloud in air
    /// that is not simulated: the density sum underestimates the density at the surface of the cloud.
    bool tension = true;
};

/// Work of sub-steps in units of base::WorkBudget.
namespace gas_work {
constexpr uint64_t kParts = 16;
/// work of prediction and search for each existing particle, in units of 1 / kParts
constexpr uint64_t kParticle = 36;
constexpr uint64_t kEvaluation =
    40; ///< work for each particle whose rates are evaluated, without the work of pairs
constexpr uint64_t kPair = 15; ///< work for each ordered pair, in units of 1 / kParts
} // namespace gas_work

/// Sums over all particles, in double precision, in a fixed order.
struct GasTotals
{
    double mass = 0;
    glm::dvec3 momentum{0.0};
    double momentumScale = 0; ///< [kg m/s] sum of m |v| over all particles
    double kinetic = 0;       ///< [J]
    double thermal = 0;       ///< [J]
    double potential = 0;     ///< [J] potential energy in gravity, and work against the ambient pressure
    double energy() const { return kinetic + thermal + potential; }
};

struct AdvanceReport
{
    double seconds = 0; ///< [s] simulated time
    double debt = 0;    ///< [s] requested time that was not simulated
    uint64_t subSteps = 0;
    uint64_t particleSteps = 0; ///< number of force evaluations: active particles, summed over sub-steps
    uint64_t pairs = 0;         ///< number of ordered neighbor pairs in force evaluations
    uint64_t searches = 0;      ///< number of times that neighbor lists were built
    uint64_t clamped = 0;       ///< number of values that were limited to keep the state finite
};

/// Columns that other physics (drag, buoyancy, combustion) may read and change between two calls of
/// advance(). Arrays are indexed by slot. The order of slots changes with every advance(); id[slot] is the
/// index with which the particle was added. After writing, call edited().
template <class T>
struct GasView
{
    uint32_t count;
    const uint32_t* id;
    T *x, *y, *z;        ///< [m]
    T *vx, *vy, *vz;     ///< [m/s]
    T* mass;             ///< [kg] > 0
    T* entropy;          ///< entropy function K of state-equation, > 0
    const T* support;    ///< [m] support H
    const T* density;    ///< [kg/m3]
    const T* pressure;   ///< [Pa]
    const T* energy;     ///< [J/kg] thermal part
    const T* divergence; ///< [1/s]
    const T* curl;       ///< [1/s]
    const T* viscosity;  ///< [1] viscosity coefficient alpha
    const T* exposure;   ///< [1] 0 deep inside the gas, about 1 on a free surface
};

/// Checks a definition. @return an error if a value is not finite or outside the range stated at its member
base::Status checkGasDynamicsDef(const GasDynamicsDef& def);

template <class T>
class GasDynamics
{
public:
    /// Creates a gas without particles.
    /// @param def a definition that checkGasDynamicsDef() accepts
    GasDynamics(const GasDynamicsDef& def, std::pmr::memory_resource* memory);
    ~GasDynamics();

    /// Adds particles between two calls of advance(). Ids are assigned in order, beginning with 0. On an
    /// error, the state does not change. Errors are: too many particles, values that are not finite,
    /// positions outside of the domain or beyond 1e9 m, and speeds beyond 1e9 m/s. Masses must be in [1e-20,
    /// 1e20] kg, energies in [0, 1e18] J/kg.
    base::Status add(std::span<const GasParticle> particles);
    /// Solves for supports and densities and converts energies to entropies. Also evaluates data that
    /// edited(), inject() or setEnergy() have invalidated. advance() calls this function if necessary. Has no
    /// effect if all data are valid.
    void initialize(base::TaskRunner& tasks);

    /// Advances by `seconds`. 0 changes nothing. NaN, infinite and negative values are errors, and the state
    /// does not change. After the call, all particles are at the same time. NaN never enters the state: if
    /// the result of a particle is NaN, its values do not change, and the report counts the particle.
    /// @param work budget of the sub-steps. If the budget is used up before the end, isAdvancing() is true.
    /// The
    ///         call must then be repeated, before any other call, until isAdvancing() is false. The sub-steps
    ///         are the same as in a single call, and the last report covers all calls
    base::Result<AdvanceReport> advance(double seconds, base::TaskRunner& tasks, base::WorkBudget& work);
    base::Result<AdvanceReport> advance(double seconds, base::TaskRunner& tasks)
    {
        base::WorkBudget unlimited;
        return advance(seconds, tasks, unlimited);
    }
    bool isAdvancing() const;
    /// Discards the remaining time of an unfinished advance().
    void abandonAdvance();

    /// Adds `joules` [J] of heat to particle `id` < count(), exactly at constant density. Negative heat
    /// beyond the available energy is an error. The neighborhood of the particle is activated.
    void inject(uint32_t id, double joules);
    /// Adds heat after `delay` >= 0 [s], also in the middle of the particle's step. The error of the time is
    /// at most a thousandth of the frame.
    void injectLater(uint32_t id, double joules, double delay);
    /// Sets the internal energy [J/kg] of particle `id` at its present density.
    void setEnergy(uint32_t id, double energy);
    /// Marks derived data as outdated. Must be called after a write through view(), unless nudged() is called
    /// instead.
    void edited();
    /// Replaces edited() and setPressureScale() after small changes. Pressure, energy and speed of sound are
    /// updated at once; densities and rates are updated by the next evaluation. Therefore advance() needs no
    /// evaluation at its beginning. The first half kick of the next steps uses the forces before the change,
    /// which causes an error of first order in the step.
    void nudged(double pressureScale, base::TaskRunner& tasks);
    /// Moves particles apart that are too close (particle-shifting), by at most `longest` spacings each.
    /// Densities are updated by the next evaluation. edited() or nudged() must be called afterwards. Has no
    /// effect before initialize(). The pointers of views become invalid.
    /// @param strength [1] > 0 @param longest [1] > 0
    void shift(double strength, double longest, base::TaskRunner& tasks);

    /// Reduces the speed of sound, so that steps become longer. Pressure forces are multiplied by `scale` in
    /// (0, 1], and the speed of sound in signal speeds by the square root of `scale`. This reduction is not
    /// physical. Flows change little if their Mach number at the reduced speed of sound is below 0.3. The
    /// kinetic energy from expansion is multiplied by `scale`. Therefore total energy is not conserved.
    void setPressureScale(double scale);
    double pressureScale() const;

    uint32_t count() const;
    const GasDynamicsDef& definition() const;
    GasView<T> view();
    GasView<const T> view() const;
    uint32_t placeOf(uint32_t id) const;
    GasParticle particle(uint32_t id) const; ///< state of the particle `id`
    double densityOf(uint32_t id) const;     ///< [kg/m3]
    double pressureOf(uint32_t id) const;    ///< [Pa]
    double supportOf(uint32_t id) const;     ///< [m]
    double stepOf(uint32_t id) const; ///< [s] longest step that the criteria now allow for the particle
    GasTotals totals() const;
    uint64_t hash() const; ///< hash of the whole state, independent of the order of slots

    /// Saves the whole state as bytes, and restores it into an object of the same definition. A restored
    /// object gives the same bits. Damaged or unsuitable bytes are an error, and the state does not change.
    /// Bytes with the right checksum but impossible values are an error, and all particles are removed.
    void save(std::vector<std::byte>& out) const;
    base::Status restore(std::span<const std::byte> bytes);

private:
    std::unique_ptr<DynamicsState<T>> state_;
};

extern template class GasDynamics<float>;
extern template class GasDynamics<double>;

} // namespace fx::sim
