// The functions of fx_preset_load.h.
#include "fxsdk/api/check.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/preset_load_object.h"
#include "fxsdk/api/preset_loading.h"
#include "fxsdk/api/versioned_struct.h"

#include <algorithm>
#include <utility>

namespace {

using fx::base::Code;
using fx::base::Status;

const FxLog* logOf(const FxPresetLoad* load)
{
    return load ? &load->context->def.log : nullptr;
}

Status canceled(const FxPresetLoad& load)
{
    return {Code::Interrupted, "the load of \"" + std::string(load.path) + "\" was canceled"};
}

bool hasEnded(FxPresetLoadState state)
{
    return state != FX_PRESET_LOAD_WAITING && state != FX_PRESET_LOAD_RUNNING;
}

/// Loads, and turns exceptions into a status, because the load keeps its outcome.
Status outcomeOf(FxPresetLoad& load, FxPresetId& outPreset)
{
    try {
        const std::string path(load.path);
        if (!load.hasText && path.starts_with(fx::api::kLibraryPrefix))
            return fx::api::loadLibraryPreset(*load.context, path, &load.monitor, outPreset);
        return fx::api::loadPreset(*load.context, {path, load.text, load.hasText}, &load.monitor, outPreset);
    } catch (const fx::asset::LoadCanceled&) {
        return canceled(load);
    } catch (const fx::base::OutOfMemory& exception) {
        return {Code::OutOfMemory, exception.what()};
    } catch (const std::bad_alloc&) {
        return {Code::OutOfMemory, "the allocator returned null"};
    } catch (const std::exception& exception) {
        return {Code::Internal, exception.what()};
    }
}

Status run(FxPresetLoad& load)
{
    {
        const std::scoped_lock lock(load.mutex);
        if (load.state == FX_PRESET_LOAD_RUNNING)
            return {Code::ReEntrant, "the load runs already, on another thread or around this callback"};
        if (hasEnded(load.state))
            return load.outcome;
        load.state = FX_PRESET_LOAD_RUNNING;
    }
    FxPresetId preset{};
    Status status = outcomeOf(load, preset);
    const std::scoped_lock lock(load.mutex); // after it is unlocked, another thread may destroy the load
    if (status.code() == Code::ReEntrant) {
        if (!load.monitor.isCanceled()) {
            load.state = FX_PRESET_LOAD_WAITING; // the caller may try again from elsewhere
            return status;
        }
        status = canceled(load);
    }
    load.state = status.ok()                          ? FX_PRESET_LOAD_READY
                 : status.code() == Code::Interrupted ? FX_PRESET_LOAD_CANCELED
                                                      : FX_PRESET_LOAD_FAILED;
    load.preset = preset;
    load.outcome = status;
    return status;
}

Status checkBegin(const FxContext* context, const char* path, const char* text, size_t length,
                  FxPresetLoad** outLoad)
{
    fx::api::Checks check;
    check.notNull(context, "context");
    check.notNull(path, "path");
    check.notNull(outLoad, "outLoad");
    check.that(text || length == 0, "text is null and length is not 0: give both, or none");
    if (!check.status())
        return check.status();
    return text ? fx::api::checkPresetLength(length) : Status();
}

/// Unloads a preset that the host cannot unload, because it never got the id.
void unloadUntaken(const FxPresetLoad& load)
{
    if (load.state == FX_PRESET_LOAD_READY && !load.isTaken)
        (void)fxUnloadPreset(load.context, load.preset);
}

} // namespace

void fx::api::freePresetLoad(FxPresetLoad* load)
{
    std::pmr::polymorphic_allocator<>(&load->context->memory).delete_object(load);
}

FxResult fxBeginPresetLoad(FxContext* context, const char* path, const char* text, size_t length,
                           FxPresetLoad** outLoad)
{
    return fx::api::guarded("fxBeginPresetLoad", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkBegin(context, path, text, length, outLoad); !status)
            return status;
        const auto free = [](FxPresetLoad* load) { fx::api::freePresetLoad(load); };
        std::unique_ptr<FxPresetLoad, decltype(free)> load(
            std::pmr::polymorphic_allocator<>(&context->memory).new_object<FxPresetLoad>(context), free);
        load->path = path;
        load->hasText = text != nullptr;
        if (text)
            load->text.assign(text, length);
        const fx::api::SharedCaller::Scope tables(context->tables); // not while a long text is copied
        if (!tables.status())
            return tables.status();
        context->loads.push_back(load.get());
        *outLoad = load.release();
        return {};
    });
}

FxResult fxPresetLoad_Run(FxPresetLoad* load)
{
    return fx::api::guarded("fxPresetLoad_Run", logOf(load),
                            [&]() -> Status { return load ? run(*load) : fx::api::invalid("load is null"); });
}

FxResult fxPresetLoad_GetProgress(FxPresetLoad* load, FxPresetLoadProgress* ioProgress)
{
    return fx::api::guarded("fxPresetLoad_GetProgress", logOf(load), [&]() -> Status {
        if (!load)
            return fx::api::invalid("load is null");
        FxPresetLoadProgress progress{};
        {
            const std::scoped_lock lock(load->mutex); // before the fraction is read, which only grows
            progress.state = uint32_t(load->state);
        }
        const fx::asset::LoadMonitor::Progress now = load->monitor.progress();
        static_assert(sizeof progress.item == fx::asset::LoadMonitor::kItemBytes);
        progress.fraction = progress.state == FX_PRESET_LOAD_READY ? 1.0f : now.fraction;
        progress.filesRead = now.filesRead;
        std::copy(now.item.begin(), now.item.end(), progress.item);
        return fx::api::writeStruct(progress, ioProgress, "ioProgress");
    });
}

FxResult fxPresetLoad_Cancel(FxPresetLoad* load)
{
    return fx::api::guarded("fxPresetLoad_Cancel", logOf(load), [&]() -> Status {
        if (!load)
            return fx::api::invalid("load is null");
        load->monitor.cancel(); // first: the message needs memory, which may have run out
        Status outcome = canceled(*load);
        const std::scoped_lock lock(load->mutex);
        if (load->state == FX_PRESET_LOAD_WAITING) {
            load->state = FX_PRESET_LOAD_CANCELED;
            load->outcome = std::move(outcome);
        }
        return {};
    });
}

FxResult fxPresetLoad_Finish(FxPresetLoad* load, FxPresetId* outPreset)
{
    return fx::api::guarded("fxPresetLoad_Finish", logOf(load), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(load, "load");
        check.notNull(outPreset, "outPreset");
        if (!check.status())
            return check.status();
        const std::scoped_lock lock(load->mutex);
        if (!hasEnded(load->state))
            return fx::api::invalid("the load has not ended: call fxPresetLoad_Run, and wait until "
                                    "fxPresetLoad_GetProgress reports another state");
        if (!load->outcome)
            return load->outcome;
        *outPreset = load->preset;
        load->isTaken = true;
        return {};
    });
}

FxResult fxDestroyPresetLoad(FxPresetLoad* load)
{
    return fx::api::guarded("fxDestroyPresetLoad", logOf(load), [&]() -> Status {
        if (!load)
            return {};
        {
            const std::scoped_lock lock(load->mutex);
            if (load->state == FX_PRESET_LOAD_RUNNING)
                return {Code::ReEntrant,
                        "fxPresetLoad_Run is in progress: call fxPresetLoad_Cancel, and wait "
                        "until it has returned"};
        }
        unloadUntaken(*load);
        const fx::api::SharedCaller::Scope tables(load->context->tables);
        if (!tables.status())
            return tables.status();
        std::erase(load->context->loads, load);
        fx::api::freePresetLoad(load);
        return {};
    });
}
