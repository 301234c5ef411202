#include "embedded/blocks_schema.h"
#include "fxsdk/presets/blocks/block_parts_preset.h"
#include "fxsdk/presets/blocks/blocks_technique.h"
#include "fxsdk/presets/emitters/birth_count.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "fxsdk/presets/field_detail_preset.h"
#include "fxsdk/presets/layer_names.h"

#include <algorithm>
#include <string>

namespace fx::preset {

namespace {

std::string partNamed(std::string_view name)
{
    for (const base::EmbeddedText& entry : blocks_schema::texts())
        if (entry.name == name)
            return std::string(entry.text);
    return {};
}

/// Replaces the string `"@name"` wherever it stands for a schema.
void insertPart(const std::string& name, const std::string& part, std::string& io)
{
    const std::string mark = "\"@" + name + "\"";
    for (size_t at = io.find(mark); at != std::string::npos; at = io.find(mark, at + part.size()))
        io.replace(at, mark.size(), part);
}

std::string assembledSchema()
{
    std::string text = partNamed("blocks.schema.json");
    insertPart("builder", partNamed("block_builder.schema.json"), text);
    insertPart("blocks", partNamed("block_list.schema.json"), text);
    insertPart("emitter", std::string(emitterSchema()), text);
    return text;
}

/// Where the blocks of the effect come from, of which there is exactly one.
void readInstances(const PresetValue& element, sim::BlocksDef& out)
{
    size_t sources = 0;
    for (const char* member : {"blocks", "builder", "emitter"})
        sources += element.has(member) ? 1 : 0;
    if (sources != 1)
        return element.error("types", "found " + std::to_string(sources) +
                                          " sources of blocks; this needs one of blocks, builder and "
                                          "emitter beside types");
    if (element.has("blocks"))
        return readBlockList(element, out.types, out.blocks);
    if (element.has("builder")) {
        if (!element.child("builder").has("of"))
            return element.child("builder").error("form", "found no types of its blocks; add \"of\"");
        return readBuiltBlocks(element, out.types, out.blocks);
    }
    if (!element.has("of"))
        return element.error("emitter", "found no types of its blocks; add \"of\" beside it");
    out.emitted = readBlockNames(element, out.types);
    out.emitter = readBlockEmitter(element, out.detail);
}

const sim::BlocksDef* blocksAt(const sim::EffectDef& effect, size_t place)
{
    for (const auto& solver : effect.solvers)
        if (const auto* const blocks = dynamic_cast<const sim::BlocksDef*>(solver.get());
            blocks && place-- == 0)
            return blocks;
    return nullptr;
}

void lintTypes(const PresetValue& element, const sim::BlocksDef& blocks)
{
    std::vector<bool> isUsed(blocks.types.size());
    const auto use = [&](const std::vector<sim::BlockPlacement>& placed) {
        for (const sim::BlockPlacement& block : placed)
            isUsed[block.type] = true;
    };
    use(blocks.blocks);
    for (const uint32_t type : blocks.emitted)
        isUsed[type] = true;
    for (size_t i = blocks.types.size(); i-- > 0;) {
        if (isUsed[i])
            use(blocks.types[i].blocks);
        else
            element.element("types", i).warning("name", "no block has this type; remove it");
    }
}

} // namespace

std::string_view blocksSchema()
{
    static const std::string text = assembledSchema();
    return text;
}

void buildBlocks(const PresetValue& element, sim::EffectDef& effect)
{
    auto blocks = std::make_unique<sim::BlocksDef>();
    element.read("name", blocks->name);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayerNames),
                 blocks->layer);
    element.read("density", blocks->density);
    element.read("fireShare", blocks->fireShare);
    element.read("anisotropy", blocks->anisotropy);
    element.read("maxParticles", blocks->maxParticles);
    blocks->turn = readBlockTurn(element);
    readFieldDetail(element, blocks->detail);
    if (!element.has("types"))
        element.error("types", "found no types; this needs what blocks consist of");
    readBlockTypes(element, blocks->types);
    if (blocks->types.size() == element.size("types") && !blocks->types.empty())
        readInstances(element, *blocks);
    effect.solvers.push_back(std::move(blocks));
}

void lintBlocks(const PresetValue& root, const sim::EffectDef& effect)
{
    for (size_t i = 0; i < root.size("blocks"); ++i) {
        const sim::BlocksDef* const blocks = blocksAt(effect, i);
        if (!blocks)
            continue;
        const PresetValue element = root.element("blocks", i);
        lintTypes(element, *blocks);
        if (const uint64_t count = blocks->expandedCount(); count > blocks->maxParticles)
            element.warning("maxParticles", "the blocks have up to " + std::to_string(count) +
                                                " balls, of which " + std::to_string(blocks->maxParticles) +
                                                " are drawn; raise it, or use fewer blocks");
    }
}

void estimateBlocks(const PresetValue&, const sim::EffectDef& effect, std::span<SolverCost> ioCosts)
{
    for (size_t i = 0; i < ioCosts.size(); ++i) {
        const sim::BlocksDef* const blocks = blocksAt(effect, i);
        if (!blocks)
            continue;
        SolverCost& cost = ioCosts[i];
        cost.memoryMember = "maxParticles";
        cost.workMember = "types";
        cost.bytes += blocks->sharedBytes();
        if (!blocks->emitter)
            continue;
        const sim::Emission& emission = blocks->emitter->emission;
        const auto capacity = double(blocks->emitter->maxParticles);
        sim::StepLoad load{kCostStep};
        load.births = std::min(ownBirths(emission, kCostStep), capacity);
        load.alive = std::min(ownBirths(emission, double(blocks->emitter->lifetime.max)), capacity);
        cost.stepWork = blocks->workOf(load);
        cost.workMember = "emitter/emission";
    }
}

} // namespace fx::preset
