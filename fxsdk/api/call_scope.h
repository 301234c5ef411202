/// @file call_scope.h
/// The thread rules of the C API: who may call an object, and who is inside it already.
#pragma once

#include "foundation/result/status.h"

#include <atomic>
#include <mutex>
#include <thread>

namespace fx::api {

/// The thread an object belongs to.
class ThreadOwner
{
public:
    void adopt() { owner_.store(std::this_thread::get_id()); }
    bool isCaller() const { return owner_.load() == std::this_thread::get_id(); }

private:
    std::atomic<std::thread::id> owner_{std::this_thread::get_id()};
};

/// An object that one thread uses, and that callbacks must not enter again. Cheap: no lock.
class SingleCaller
{
public:
    ThreadOwner thread;

    /// Held while a call is inside the object.
    class Scope
    {
    public:
        Scope(SingleCaller& caller, const char* rule)
        {
            if (!caller.thread.isCaller())
                rule_ = rule;
            else if (!caller.busy_)
                entered_ = &caller;
            if (entered_)
                entered_->busy_ = true;
        }
        ~Scope()
        {
            if (entered_)
                entered_->busy_ = false;
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        explicit operator bool() const { return entered_ != nullptr; }
        base::Status status() const ///< made when it is asked for: every call passes through here
        {
            if (entered_)
                return {};
            return rule_ ? base::Status(base::Code::WrongThread, rule_)
                         : base::Status(base::Code::ReEntrant,
                                        "a callback must not call the object that is calling it");
        }

    private:
        SingleCaller* entered_ = nullptr;
        const char* rule_ = nullptr; ///< that was broken
    };

    /// For the owner's thread or one that is about to become it.
    bool busy() const { return busy_; }

private:
    bool busy_ = false; ///< read and written by the owning thread only
};

/// An object that many threads use one after the other, and that callbacks must not enter again.
class SharedCaller
{
public:
    class Scope
    {
    public:
        explicit Scope(SharedCaller& caller)
        {
            if (caller.inside_.load() == std::this_thread::get_id()) {
                status_ = {base::Code::ReEntrant, "a callback must not call the context that is calling it"};
                return;
            }
            caller.mutex_.lock();
            caller.inside_.store(std::this_thread::get_id());
            entered_ = &caller;
        }
        ~Scope()
        {
            if (!entered_)
                return;
            entered_->inside_.store(std::thread::id());
            entered_->mutex_.unlock();
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        const base::Status& status() const { return status_; }

    private:
        SharedCaller* entered_ = nullptr;
        base::Status status_;
    };

private:
    std::mutex mutex_;
    std::atomic<std::thread::id> inside_{std::thread::id()};
};

} // namespace fx::api
