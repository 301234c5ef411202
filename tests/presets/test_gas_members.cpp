#include "simulation/gas/gas_def.h"
#include "tests/presets/member_probe.h"

using namespace fx::test;

namespace {

Fields fieldsOf(const fx::sim::SolverDef& solver)
{
    const auto& g = dynamic_cast<const fx::sim::GasDef&>(solver);
    Fields fields{double(g.particles),
                  g.start,
                  g.energy,
                  double(g.material->name.size()),
                  g.pressureRatio,
                  g.soundSpeed,
                  g.jitter,
                  g.lumpiness,
                  g.throwSpeed,
                  g.entrainment,
                  g.radiation,
                  g.drag,
                  g.braking,
                  g.buoyancy,
                  g.rolling,
                  g.curlStrength,
                  g.curlScale,
                  g.viscosity,
                  g.opacity,
                  g.sootTemperature,
                  g.growth,
                  g.heat,
                  g.dissipation,
                  g.detailAmount,
                  g.detailScale,
                  g.anisotropy};
    add(fields, g.position);
    add(fields, g.initialBias);
    add(fields, g.smokeTint);
    return fields;
}

} // namespace

TEST(GasMembers, eachIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    const Json schema = fx::preset::presetSchema()["properties"]["gas"]["items"];
    probeMembers("gas", schema, Json::object(), "", fieldsOf);
}
