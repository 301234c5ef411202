/// @file call_scope.h
/// Checks of the thread rules of the C API: an object is called on its thread only, and no other call on the
/// object is in progress.
#pragma once

#include "foundation/result/status.h"

#include <atomic>
#include <mutex>
#include <thread>

namespace fx::api {

/// The thread to which an object belongs.
class ThreadOwner
{
public:
    void adopt() { owner_.store(std::this_thread::get_id()); }
    bool isCaller() const { return owner_.load() == std::this_thread::get_id(); }

private:
    std::atomic<std::thread::id> owner_{std::this_thread::get_id()};
};

/// Guards an object that only one thread uses and that callbacks must not re-enter. The guard needs no lock.
class SingleCaller
{
public:
    ThreadOwner thread;

    /// Marks a call as inside the object, during the lifetime of the scope.
    class Scope
    {
    public:
        Scope(SingleCaller& caller, const char* rule)
        {
            if (!caller.thread.isCaller())
                rule_ = rule;
            else if (!caller.busy())
                entered_ = &caller;
            if (entered_)
                entered_->busy_.store(true, std::memory_order_relaxed);
        }
        ~Scope()
        {
            if (entered_)
                entered_->busy_.store(false, std::memory_order_relaxed);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        explicit operator bool() const { return entered_ != nullptr; }
        /// Refuses further calls, because the object will be destroyed. The scope does not access the object
        /// afterwards.
        void close()
        {
            entered_->close();
            entered_ = nullptr;
        }
        /// the result of the checks as a status
        base::Status status() const
        {
            if (entered_)
                return {};
            return rule_ ? base::Status(base::Code::WrongThread, rule_)
                         : base::Status(base::Code::ReEntrant,
                                        "a callback must not call the object that is calling it");
        }

    private:
        SingleCaller* entered_ = nullptr;
        const char* rule_ = nullptr; ///< description of the thread rule that was broken; null if none was
    };

    /// Whether a call is in progress. [any thread]
    bool busy() const { return busy_.load(std::memory_order_relaxed); }
    /// Refuses further calls, such as calls from callbacks while the object is destroyed.
    void close()
    {
        closed_.store(true, std::memory_order_relaxed);
        busy_.store(true, std::memory_order_relaxed);
    }
    /// Whether the object is closed. This query is for functions that may run during another call.
    bool isClosed() const { return closed_.load(std::memory_order_relaxed); }

private:
    std::atomic<bool> busy_{false};   ///< whether a call is in progress; written by the owning thread only
    std::atomic<bool> closed_{false}; ///< whether the object is closed; written by the owning thread only
};

/// Guards an object that many threads use one after another and that callbacks must not re-enter.
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
        /// Releases the lock before the object is destroyed. This thread remains inside the object, so that
        /// calls from callbacks are refused. The scope does not access the object afterwards.
        void close()
        {
            entered_->mutex_.unlock();
            entered_ = nullptr;
        }

    private:
        SharedCaller* entered_ = nullptr;
        base::Status status_;
    };

private:
    std::mutex mutex_;
    std::atomic<std::thread::id> inside_{std::thread::id()};
};

} // namespace fx::api
