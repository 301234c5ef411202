#include "fxsdk/api/context.h"

#include <algorithm>
#include <thread>

namespace {

std::unique_ptr<fx::base::TaskRunner> makeTasks(const FxContextDef& def)
{
    if (def.parallelFor.run)
        return fx::base::makeHostRunner({def.parallelFor.user, def.parallelFor.run});
    const uint32_t most =
        std::max(std::thread::hardware_concurrency(), 1u); // asked for more, TBB prints a warning
    const uint32_t workers = std::min(def.workers == 0 ? most : def.workers, most);
    return workers == 1 ? fx::base::makeSerialRunner() : fx::base::makeTbbRunner(workers);
}

} // namespace

FxContext::FxContext(const FxContextDef& given, const fx::api::TechniqueLists& techniquesGiven)
    : def(given), world(given), techniques(techniquesGiven), memory(fx::api::toHooks(given.allocator)),
      tasks(makeTasks(given)), presets(&memory, uint32_t(fx::scene::kIdPartMask)), scenes(&memory),
      views(&memory), loads(&memory)
{
    fx::preset::registerKinds(schema, techniques.presets);
}

fx::base::Result<std::shared_ptr<const fx::sim::EffectDef>> FxContext::findPreset(FxPresetId id)
{
    const fx::api::SharedCaller::Scope scope(tables);
    if (!scope.status())
        return scope.status();
    const fx::api::HeldPreset* preset = presets.find(ids.decode(id.bits, fx::api::kPresetIdType));
    if (!preset)
        return fx::base::Status(fx::base::Code::StaleId, "preset names no loaded preset of this context");
    return preset->effect;
}

std::shared_ptr<const fx::sim::EffectDef> FxContext::findPreset(uint64_t fingerprint)
{
    const fx::api::SharedCaller::Scope scope(tables);
    std::shared_ptr<const fx::sim::EffectDef> found;
    if (scope.status().ok())
        presets.forEach([&](uint32_t, const fx::api::HeldPreset& preset) {
            if (!found && preset.effect->fingerprint == fingerprint)
                found = preset.effect;
        });
    return found;
}

namespace fx::api {

base::AllocatorHooks toHooks(const FxAllocator& allocator)
{
    return {allocator.user, allocator.allocate, allocator.release};
}

void logMessage(const FxContext& context, FxLogLevel level, const char* message)
{
    if (context.def.log.write)
        context.def.log.write(context.def.log.user, level, FX_OK, message);
}

} // namespace fx::api
