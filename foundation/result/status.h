/// @file status.h
/// The outcome of an operation that can fail: a code that programs branch on and a message for people.
///
/// The codes equal the codes of the C API (fxsdk/include/fxsdk/fx_base.h). Assertions in fxsdk/api check the
/// equality.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace fx::base {

/// Outcome codes. 0 is success; errors are negative.
enum class Code : int
{
    Ok = 0,
    InvalidArgument = -1, ///< an argument is null, not finite, or outside its range
    /// The id belongs to an object that never existed or was destroyed, or to an object of another kind.
    StaleId = -2,
    WrongThread = -3,    ///< the function must not be called on the calling thread
    OutOfMemory = -4,    ///< the allocator returned null
    Capacity = -5,       ///< a stated capacity is used up
    NotFound = -6,       ///< a file or asset does not exist
    TooLarge = -7,       ///< an input exceeds its documented size limit and was not read
    Parse = -8,          ///< a text is not well formed
    Schema = -9,         ///< a preset or scene is well-formed JSON but violates its schema
    Version = -10,       ///< this library does not support the version of a struct, preset or header
    GlUnsupported = -11, ///< the GL context lacks a version or function that is required
    GlFailed = -12,      ///< GL reported an error for a shader, a framebuffer or an allocation
    NoGl = -13,          ///< the context was created without GL, so it cannot draw
    ReEntrant = -14,     ///< a callback called a function of the object that was calling the callback
    Io = -15,            ///< the operating system refused to read or write
    Interrupted = -16,   ///< the user stopped the operation
    HostAnswer = -17,    ///< a callback of the host returned an invalid value
    GlLost = -18,        ///< the GL context is lost, with all objects in it
    Internal = -99,      ///< a defect of this library
};

/// The code's identifier, such as "invalid-argument".
const char* codeName(Code code);

/// A code and, for codes other than Ok, a message that names the cause and the remedy.
class [[nodiscard]] Status
{
public:
    Status() = default;
    Status(Code code, std::string message) : code_(code), message_(std::move(message)) {}

    bool ok() const { return code_ == Code::Ok; }
    explicit operator bool() const { return ok(); }
    Code code() const { return code_; }
    const std::string& message() const { return message_; }

private:
    Code code_ = Code::Ok;
    std::string message_;
};

/// A value; or, if an operation failed, the status of the failure.
template <class T>
class [[nodiscard]] Result
{
public:
    Result(T value) : value_(std::move(value)) {}
    Result(Status status) : status_(std::move(status)) {}

    bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    const Status& status() const { return status_; }
    T& value() { return *value_; }
    const T& value() const { return *value_; }
    T& operator*() { return *value_; }
    const T& operator*() const { return *value_; }
    T* operator->() { return &*value_; }
    const T* operator->() const { return &*value_; }

private:
    std::optional<T> value_;
    Status status_;
};

} // namespace fx::base
