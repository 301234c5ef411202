#include "benchmarks/verify/verify_report.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace fx::cli {
namespace {

[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...)
{
    char buffer[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

std::string hashText(uint64_t hash)
{
    return formatted("0x%016llx", static_cast<unsigned long long>(hash));
}

nlohmann::json limitsJson(const sim::CaseMeasures& measures)
{
    nlohmann::json limits = nlohmann::json::array();
    for (const sim::CaseLimit& limit : measures.limits) {
        limits.push_back({{"name", limit.name},
                          {"value", numberOrNull(limit.value)},
                          {"low", numberOrNull(limit.low)},
                          {"high", numberOrNull(limit.high)},
                          {"holds", limit.holds()}});
    }
    return limits;
}

std::string row(const std::string& name, double value, double expected, const std::string& note)
{
    const std::string text = std::isnan(expected) ? std::string(11, ' ') : formatted("%11.5g", expected);
    return formatted("  %-28s %11.5g %s  %s\n", name.c_str(), value, text.c_str(), note.c_str());
}

std::string errorRows(const sim::CaseMeasures& m)
{
    std::string text;
    if (!std::isnan(m.l1Density))
        text += row("L1 density", m.l1Density, sim::kNotMeasured, "mean error by volume") +
                row("L1 velocity", m.l1Velocity, sim::kNotMeasured, "") +
                row("L1 pressure", m.l1Pressure, sim::kNotMeasured, "");
    if (!std::isnan(m.shockRadius))
        text += row("shock radius", m.shockRadius, m.shockRadiusExact, "[m]");
    for (const sim::Measure& measure : m.more)
        text += row(measure.name, measure.value, measure.expected, measure.meaning);
    return text;
}

std::string limitRows(const sim::CaseMeasures& m)
{
    std::string text;
    for (const sim::CaseLimit& limit : m.limits)
        text += formatted("  %-28s %11.4g  %s %.4g .. %.4g\n", limit.name.c_str(), limit.value,
                          limit.holds() ? "within" : "BEYOND", limit.low, limit.high);
    return text;
}

} // namespace

nlohmann::json numberOrNull(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

double nanosecondsPerParticleStep(const sim::CaseReport& report)
{
    return report.work.particleSteps > 0 ? 1e9 * report.steppingSeconds / double(report.work.particleSteps)
                                         : 0;
}

double nanosecondsPerPair(const sim::CaseReport& report)
{
    return report.work.pairs > 0 ? 1e9 * report.steppingSeconds / double(report.work.pairs) : 0;
}

bool limitsHold(const sim::CaseReport& report)
{
    for (const sim::CaseLimit& limit : report.measures.limits) {
        if (!limit.holds())
            return false;
    }
    return true;
}

nlohmann::json toJson(const VerifyPlan& plan, const sim::CaseReport& report)
{
    const sim::CaseMeasures& m = report.measures;
    const sim::GasDynamicsDef& rules = plan.settings.rules;
    nlohmann::json json = {{"case", plan.entry->name},
                           {"particles", report.particles},
                           {"neighbors", rules.neighbors},
                           {"kernel", kernelName(rules.kernel)},
                           {"precision", plan.doublePrecision ? "double" : "float"},
                           {"steps_mode", stepsName(rules.steps)},
                           {"courant", rules.courant},
                           {"threads", plan.threads},
                           {"seed", nullptr},
                           {"time", report.seconds},
                           {"l1_density", numberOrNull(m.l1Density)},
                           {"l1_velocity", numberOrNull(m.l1Velocity)},
                           {"l1_pressure", numberOrNull(m.l1Pressure)},
                           {"shock_radius", numberOrNull(m.shockRadius)},
                           {"shock_radius_exact", numberOrNull(m.shockRadiusExact)},
                           {"energy_drift", numberOrNull(report.energyDrift)},
                           {"momentum_drift", numberOrNull(report.momentumDrift)},
                           {"steps", report.work.subSteps},
                           {"particle_steps", report.work.particleSteps},
                           {"pairs", report.work.pairs},
                           {"searches", report.work.searches},
                           {"clamped", report.work.clamped},
                           {"ns_per_particle_step", nanosecondsPerParticleStep(report)},
                           {"ns_per_pair", nanosecondsPerPair(report)},
                           {"stepping_s", report.steppingSeconds},
                           {"wall_s", report.initialSeconds + report.steppingSeconds},
                           {"hash", hashText(report.hash)},
                           {"within_limits", limitsHold(report)},
                           {"limits", limitsJson(m)}};
    for (const sim::Measure& measure : m.more) {
        json[measure.name] = numberOrNull(measure.value);
        if (!std::isnan(measure.expected))
            json[measure.name + "_expected"] = numberOrNull(measure.expected);
    }
    return json;
}

std::string toText(const VerifyPlan& plan, const sim::CaseReport& report)
{
    const sim::GasDynamicsDef& rules = plan.settings.rules;
    std::string text = formatted("%s: %s\n", std::string(plan.entry->name).c_str(),
                                 std::string(plan.entry->summary).c_str());
    text += formatted("  %u particles, %g neighbors, %s, %s, %s steps, %u %s, to %g s\n\n", report.particles,
                      rules.neighbors, kernelName(rules.kernel), plan.doublePrecision ? "double" : "float",
                      stepsName(rules.steps), plan.threads, plan.threads == 1 ? "thread" : "threads",
                      report.seconds);
    text += formatted("  %-28s %11s %11s\n", "", "measured", "expected");
    text += errorRows(report.measures);
    text += row("energy drift", report.energyDrift, sim::kNotMeasured, "of the energy");
    if (!std::isnan(report.momentumDrift))
        text += row("momentum drift", report.momentumDrift, sim::kNotMeasured, "of the sum of m |v|");
    text +=
        formatted("\n  %llu steps, %.4g particle steps, %.4g pairs, %.3g s\n",
                  static_cast<unsigned long long>(report.work.subSteps), double(report.work.particleSteps),
                  double(report.work.pairs), report.initialSeconds + report.steppingSeconds);
    text += formatted("  %.4g ns per particle step, %.3g ns per pair\n", nanosecondsPerParticleStep(report),
                      nanosecondsPerPair(report));
    text += "  state " + hashText(report.hash) + "\n\n";
    return text + limitRows(report.measures);
}

std::string profileCsv(const sim::CaseReport& report)
{
    std::string text = "r[m],rho[kg/m3],v[m/s],p[Pa]\n";
    for (const sim::ProfilePoint& point : report.profile)
        text += formatted("%.9g,%.9g,%.9g,%.9g\n", point.place, point.state.density, point.state.velocity,
                          point.state.pressure);
    return text;
}

} // namespace fx::cli
