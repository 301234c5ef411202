#include "simulation/fragments/fragments_def.h"
#include "tests/presets/member_probe.h"

using namespace fx::test;

namespace {

void addTrail(Fields& fields, const fx::sim::TrailDef& t)
{
    fields.insert(fields.end(),
                  {t.spacing, t.idle, double(t.maxBlobs), t.coldest, t.opticalDepth, t.temperature, t.mixing,
                   t.spreading, t.inherited, t.drag, t.buoyancy, t.curlStrength, t.curlScale, t.curlRate,
                   t.detailAmount, t.detailScale, t.anisotropy});
    add(fields, t.lifetime);
    add(fields, t.radius);
    add(fields, t.albedoOverLife);
}

Fields fieldsOf(const fx::sim::SolverDef& solver)
{
    const auto& f = dynamic_cast<const fx::sim::FragmentsDef&>(solver);
    const fx::sim::FragmentMatter& m = f.matter;
    Fields fields{double(f.count), f.start,    f.originRadius, double(f.shape), f.angle, double(f.sizeLaw),
                  f.meanSize,      f.exponent, f.visibleSize,  f.shutter,       f.heat};
    fields.insert(fields.end(), {m.density, m.specificHeat, m.emissivity, m.dragCoefficient, m.gravity,
                                 m.bounce, m.friction});
    add(fields, f.position);
    add(fields, f.speed);
    add(fields, f.size);
    add(fields, f.temperature);
    add(fields, f.lifetime);
    addTrail(fields, f.trail);
    return fields;
}

const Json& schema()
{
    static const Json whole = fx::preset::presetSchema()["properties"]["fragments"]["items"];
    return whole;
}

} // namespace

TEST(FragmentsMembers, eachIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    probeMembers("fragments", schema(), Json::object(), "", fieldsOf);
}

TEST(FragmentsMembers, thoseOfMatterAndTrailAreReadToo)
{
    for (const std::string part : {"matter", "trail"})
        probeMembers("fragments", schema()["properties"][part], Json{{part, Json::object()}}, "/" + part,
                     fieldsOf);
}
