/// @file blast_wave_case.cpp
/// One kilogram of TNT that has become a ball of hot gas, in a room full of air. The ball has the charge's
/// mass and energy and a density of 100 kg/m3, from where on an ideal gas expands much as the products of TNT
/// do. One eighth of the room is simulated: mirrors stand in the planes through the center, and the outer
/// walls are too far to be heard. All particles have the same mass, so that those of the charge are packed
/// closely.
///
/// At three distances the pressure is listened to, and a Friedlander wave is fitted to it. References: what
/// is measured of TNT, and the same ball in one dimension, heard in the same way.

#include "simulation/verification/air_blast.h"
#include "simulation/verification/case_base.h"
#include "simulation/verification/flow_errors.h"
#include "simulation/verification/gas_cases.h"
#include "simulation/verification/lattice.h"
#include "simulation/verification/radial_flow.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr double kCharge = 1;        ///< [kg] of TNT
constexpr double kRoom = 3.6;        ///< [m] from the center to each wall
constexpr double kBallDensity = 100; ///< [kg/m3]
constexpr double kTime = 5.5e-3;
constexpr uint32_t kSamples = 220;
constexpr int kCells = 1200;
constexpr std::array<double, 3> kDistances = {1.5, 2.0, 2.5}; ///< [m]

using Histories = std::array<std::vector<PressureSample>, kDistances.size()>;

class BlastWaveCase final : public CaseBase
{
public:
    explicit BlastWaveCase(const CaseSettings& settings);
    void look(double time, std::span<const CaseParticle> particles) override;
    CaseMeasures measure(std::span<const CaseParticle> particles) const override;

private:
    RadialFlow makeReference() const;
    void storeOverpressures(const Histories& reference, CaseMeasures& out) const;

    double spacing_;
    double ball_; ///< [m] radius
    Histories histories_;
};

BlastWaveCase::BlastWaveCase(const CaseSettings& settings)
    : CaseBase(settings, 1.4, kTime), spacing_(kRoom / evenSide(settings.particles, 12)),
      ball_(std::cbrt(3 * kCharge / (4 * std::numbers::pi * kBallDensity)))
{
    const double mass = kAirDensity * spacing_ * spacing_ * spacing_;
    const double cold = kAirPressure / ((gamma_ - 1) * kAirDensity);
    const auto fill = [&](double spacing, double length, bool isCharge) {
        const auto side = uint32_t(std::lround(length / spacing));
        Lattice{glm::dvec3(0), spacing, glm::u32vec3(side)}.forEach([&](const glm::dvec3& position) {
            if ((glm::length(position) < ball_) == isCharge)
                particles_.push_back({position, glm::dvec3(0), mass, isCharge ? kEnergyOfTnt : cold});
        });
    };
    fill(std::cbrt(mass / kBallDensity), 1.5 * ball_, true);
    const auto charge = double(particles_.size());
    for (GasParticle& particle : particles_)
        particle.energy *= kCharge / 8 / (mass * charge); // the energy is exact, whatever the lattice
    fill(spacing_, kRoom, false);
    def_.domain.axes.fill(AxisKind::Reflecting);
    def_.domain.low = glm::dvec3(0);
    def_.domain.high = glm::dvec3(kRoom);
    finish(kSamples);
}

/// Mean over a shell as thick as particles are apart.
void BlastWaveCase::look(double time, std::span<const CaseParticle> particles)
{
    std::array<double, kDistances.size()> sums{};
    std::array<double, kDistances.size()> counts{};
    for (const CaseParticle& particle : particles) {
        const double r = glm::length(particle.position);
        for (size_t k = 0; k < kDistances.size(); ++k) {
            if (std::abs(r - kDistances[k]) < 0.5 * spacing_) {
                sums[k] += particle.pressure - kAirPressure;
                counts[k] += 1;
            }
        }
    }
    for (size_t k = 0; k < kDistances.size(); ++k)
        histories_[k].push_back({time, counts[k] > 0 ? sums[k] / counts[k] : 0});
}

RadialFlow BlastWaveCase::makeReference() const
{
    RadialFlowDef def;
    def.gamma = gamma_;
    def.cells = kCells;
    def.length = kRoom;
    def.initial = [this](double r) {
        return r < ball_ ? FlowState{kBallDensity, 0, (gamma_ - 1) * kBallDensity * kEnergyOfTnt}
                         : FlowState{kAirDensity, 0, kAirPressure};
    };
    return RadialFlow(def);
}

void BlastWaveCase::storeOverpressures(const Histories& reference, CaseMeasures& out) const
{
    const double scale = std::cbrt(kCharge);
    for (size_t k = 0; k < kDistances.size(); ++k) {
        const std::string at = "_" + std::to_string(k + 1);
        const double z = kDistances[k] / scale;
        const FriedlanderWave wave = fitFriedlander(histories_[k]);
        const FriedlanderWave expected = fitFriedlander(reference[k]);
        const double measured = kinneyGrahamOverpressure(z);
        const double highest = std::max_element(histories_[k].begin(), histories_[k].end(),
                                                [](const PressureSample& a, const PressureSample& b) {
                                                    return a.overpressure < b.overpressure;
                                                })
                                   ->overpressure;
        out.more.push_back({"distance" + at, kDistances[k], "from the charge [m]"});
        out.more.push_back(
            {"peak_overpressure" + at, wave.peak, "fitted [Pa]; TNT after Kinney and Graham", measured});
        out.more.push_back({"peak_kingery_bulmash" + at, wave.peak, "the same; TNT after Kingery and Bulmash",
                            kingeryBulmashOverpressure(z)});
        out.more.push_back(
            {"peak_reference" + at, wave.peak, "the same; the same ball in one dimension", expected.peak});
        out.more.push_back(
            {"peak_seen" + at, highest, "largest mean of a shell, smeared by the particles [Pa]"});
        out.more.push_back(
            {"arrival" + at, wave.arrival, "of the shock [s]; in one dimension", expected.arrival});
        out.more.push_back({"duration" + at, wave.duration, "of the positive phase [s]; in one dimension",
                            expected.duration});
        if (ownTime_ && particles_.size() >= 100'000)
            out.limits.push_back(
                {"peak_reference" + at, wave.peak, 0.85 * expected.peak, 1.15 * expected.peak});
    }
}

CaseMeasures BlastWaveCase::measure(std::span<const CaseParticle> particles) const
{
    RadialFlow reference = makeReference();
    Histories heard;
    for (const double time : sampleTimes()) {
        reference.advanceTo(time);
        for (size_t k = 0; k < kDistances.size(); ++k)
            heard[k].push_back({time, reference.at(kDistances[k]).pressure - kAirPressure});
    }
    CaseMeasures out;
    const double sound = std::sqrt(gamma_ * kAirPressure / kAirDensity);
    storeErrors(
        profileOf(*this, particles), 0.95 * kRoom, {kAirDensity, sound, kAirPressure},
        [&](double r) { return reference.at(r); }, out);
    storeOverpressures(heard, out);
    return out;
}

} // namespace

std::unique_ptr<GasCase> makeBlastWaveCase(const CaseSettings& settings)
{
    return std::make_unique<BlastWaveCase>(settings);
}

} // namespace fx::sim
