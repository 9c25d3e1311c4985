/*
 * ptlib for C++17: the C interface with destructors and exceptions. Header only.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * Every object owns one handle, moves, and does not copy; retain() gives a second owner where the C
 * interface counts references. What fails throws ptlib::error. Exceptions that leave a callback of
 * yours are caught before they reach the library, end the computation, and are thrown again by the
 * call that ran it. Which thread may do what is said in ptlib.h.
 */
#ifndef PTLIB_HPP
#define PTLIB_HPP

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <ptlib/ptlib.h>

namespace ptlib {

/// One thing that is wrong, of an error or of a graph file that was read nevertheless.
struct fault {
    ptl_status status;
    /// Place in the file, from 1; 0 if it concerns none.
    std::uint32_t line, column;
    ptl_block block;
    std::string param, message;

    explicit fault(const ptl_fault &fault)
        : status(fault.status), line(fault.line), column(fault.column), block(fault.block),
          param(fault.param ? fault.param : ""), message(fault.message ? fault.message : "")
    {
    }
};

/// What a call that failed throws: PTL_E_..., where, and the message in what().
class error : public std::runtime_error {
public:
    /// Copies what C tells; the error stays the caller's and may be NULL.
    error(ptl_status status, const ptl_error *reason)
        : std::runtime_error(reason ? ptl_error_message(reason) : ptl_status_name(status)),
          status_(status), block_(ptl_error_block(reason))
    {
        if (const char *param = ptl_error_param(reason)) {
            param_ = param;
        }
        for (std::uint32_t i = 0; i < ptl_error_fault_count(reason); i++) {
            ptl_fault one = {};
            one.struct_size = sizeof one;
            if (ptl_error_fault_at(reason, i, &one) == PTL_OK) {
                faults_.emplace_back(one);
            }
        }
    }

    ptl_status status() const noexcept { return status_; }
    /// The block that it concerns, or 0.
    ptl_block block() const noexcept { return block_; }
    /// The id of the parameter that it concerns, or an empty text.
    const std::string &param() const noexcept { return param_; }
    /// All faults: a graph file may have many, other errors have one.
    const std::vector<fault> &faults() const noexcept { return faults_; }

private:
    ptl_status status_;
    ptl_block block_;
    std::string param_;
    std::vector<fault> faults_;
};

/// What a cancelled computation throws.
class cancelled : public error {
public:
    using error::error;
};

namespace detail {

template <typename T, void (PTL_CALL *Release)(T *)> struct releaser {
    void operator()(T *handle) const noexcept { Release(handle); }
};

/// A handle that is released with its owner.
template <typename T, void (PTL_CALL *Release)(T *)>
using owner = std::unique_ptr<T, releaser<T, Release>>;

using error_owner = owner<ptl_error, ptl_error_release>;

[[noreturn]] inline void raise(ptl_status status, const ptl_error *reason)
{
    if (status == PTL_E_CANCELLED) {
        throw cancelled(status, reason);
    }
    throw error(status, reason);
}

/// Calls `function` with `arguments` and a place for the error; throws unless it gives PTL_OK.
template <typename Function, typename... Arguments>
void call(Function function, Arguments &&...arguments)
{
    ptl_error *reason = nullptr;
    const ptl_status status = function(std::forward<Arguments>(arguments)..., &reason);
    const error_owner owned(reason);
    if (status != PTL_OK) {
        raise(status, reason);
    }
}

/// The same for functions without a place for the error.
inline void check(ptl_status status)
{
    if (status != PTL_OK) {
        raise(status, nullptr);
    }
}

inline std::string text(const char *characters) { return characters ? characters : ""; }

/// The contents of bytes, which are released.
inline std::string take(ptl_bytes *bytes)
{
    const owner<ptl_bytes, ptl_bytes_release> owned(bytes);
    std::size_t size = 0;
    const void *data = ptl_bytes_data(bytes, &size);
    return std::string(static_cast<const char *>(data), size);
}

} // namespace detail

/// Version of the library, such as "0.1.0".
inline std::string version() { return ptl_version_string(); }

/// Bytes that belong to somebody else.
struct bytes_view {
    const std::byte *data = nullptr;
    std::size_t size = 0;

    const std::byte *begin() const noexcept { return data; }
    const std::byte *end() const noexcept { return data + size; }
};

/// A request to stop, which any thread can make.
class cancel {
public:
    cancel()
    {
        ptl_cancel *handle = nullptr;
        detail::call(ptl_cancel_create, &handle);
        handle_.reset(handle);
    }

    /// A second owner of the same request.
    cancel retain() const { return cancel(ptl_cancel_retain(handle_.get())); }

    void request() const noexcept { ptl_cancel_request(handle_.get()); }
    bool is_requested() const noexcept { return ptl_cancel_is_requested(handle_.get()) != 0; }
    ptl_cancel *get() const noexcept { return handle_.get(); }

private:
    explicit cancel(ptl_cancel *handle) : handle_(handle) {}

    detail::owner<ptl_cancel, ptl_cancel_release> handle_;
};

/// A finished picture.
class image {
public:
    explicit image(ptl_image *handle) : handle_(handle) {}

    image retain() const { return image(ptl_image_retain(handle_.get())); }

    ptl_image_info info() const
    {
        ptl_image_info info = {};
        info.struct_size = sizeof info;
        detail::check(ptl_image_get_info(handle_.get(), &info));
        return info;
    }

    std::uint32_t width() const { return info().width; }
    std::uint32_t height() const { return info().height; }

    /// The pixels in the image's format, rows without gaps. They live as long as the image.
    bytes_view pixels() const
    {
        std::size_t size = 0;
        const void *data = ptl_image_pixels(handle_.get(), &size);
        if (data == nullptr) {
            throw std::bad_alloc();
        }
        return {static_cast<const std::byte *>(data), size};
    }

    /// The pixels as numbers of type T, which must have the size of a channel of the format.
    template <typename T> const T *pixels_as() const
    {
        if (info().bytes_per_channel != sizeof(T)) {
            throw std::invalid_argument("the channels of the image have another size");
        }
        return reinterpret_cast<const T *>(pixels().data);
    }

    /// Copies the pixels in any format; a stride of 0 is rows without gaps.
    void copy(ptl_format format, void *target, std::size_t size, std::size_t row_stride = 0) const
    {
        detail::call(ptl_image_copy, handle_.get(), format, target, size, row_stride);
    }

    void save(const std::string &path) const
    {
        detail::call(ptl_image_save, handle_.get(), path.c_str());
    }

    ptl_image *get() const noexcept { return handle_.get(); }

private:
    detail::owner<ptl_image, ptl_image_release> handle_;
};

/// What flows on a wire: a mesh, points, strands, a text, a colour transition or an image.
class value {
public:
    /// Called once, when memory that was lent is needed no longer; it must not throw.
    using release = std::function<void()>;

    explicit value(ptl_value *handle) : handle_(handle) {}

    /// Copies the caller's data.
    explicit value(const ptl_mesh_data &mesh) : value(made(ptl_value_from_mesh, mesh)) {}
    explicit value(const ptl_points_data &points) : value(made(ptl_value_from_points, points)) {}
    explicit value(const ptl_strands_data &strands) : value(made(ptl_value_from_strands, strands))
    {
    }
    explicit value(const ptl_gradient_data &gradient)
        : value(made(ptl_value_from_gradient, gradient))
    {
    }
    explicit value(const ptl_image_data &image) : value(made(ptl_value_from_image, image)) {}
    explicit value(std::string_view text) : value(made_of_text(text)) {}

    /// Uses the caller's data where it is, until `done` is called. That happens also if this
    /// throws.
    static value borrow(const ptl_mesh_data &mesh, release done)
    {
        return value(lent(ptl_value_from_mesh, mesh, std::move(done)));
    }
    static value borrow(const ptl_points_data &points, release done)
    {
        return value(lent(ptl_value_from_points, points, std::move(done)));
    }
    static value borrow(const ptl_strands_data &strands, release done)
    {
        return value(lent(ptl_value_from_strands, strands, std::move(done)));
    }

    value retain() const { return value(ptl_value_retain(handle_.get())); }

    /// One of PTL_KIND_...
    std::uint32_t kind() const noexcept { return ptl_value_kind(handle_.get()); }

    /// Where the data is; it lives as long as the value.
    ptl_mesh_data mesh() const { return view<ptl_mesh_data>(ptl_value_mesh); }
    ptl_points_data points() const { return view<ptl_points_data>(ptl_value_points); }
    ptl_strands_data strands() const { return view<ptl_strands_data>(ptl_value_strands); }
    ptl_gradient_data gradient() const { return view<ptl_gradient_data>(ptl_value_gradient); }
    std::string_view text() const
    {
        const auto text = view<ptl_text_data>(ptl_value_text);
        return {text.text, text.size};
    }

    ptlib::image image(ptl_format format = PTL_FORMAT_AUTO) const
    {
        ptl_image *result = nullptr;
        detail::call(ptl_value_image, handle_.get(), format, &result);
        return ptlib::image(result);
    }

    ptl_value *get() const noexcept { return handle_.get(); }

private:
    template <typename Data>
    using maker = ptl_status(PTL_CALL *)(const Data *, std::uint32_t, ptl_free_fn, void *,
                                         ptl_value **, ptl_error **);

    template <typename Data> static ptl_value *made(maker<Data> make, const Data &data)
    {
        ptl_value *result = nullptr;
        detail::call(make, &data, 0u, nullptr, nullptr, &result);
        return result;
    }

    static ptl_value *made_of_text(std::string_view text)
    {
        ptl_text_data data = {};
        data.struct_size = sizeof data;
        data.text = text.data();
        data.size = text.size();
        return made(ptl_value_from_text, data);
    }

    template <typename Data>
    static ptl_value *lent(maker<Data> make, const Data &data, release done)
    {
        auto *owned = new release(std::move(done));
        ptl_value *result = nullptr;
        detail::call(make, &data, std::uint32_t{PTL_VALUE_BORROW}, &end_loan, owned, &result);
        return result;
    }

    static void PTL_CALL end_loan(void *user_data) noexcept
    {
        const std::unique_ptr<release> done(static_cast<release *>(user_data));
        if (*done) {
            (*done)();
        }
    }

    template <typename Data, typename Function> Data view(Function function) const
    {
        Data data = {};
        data.struct_size = sizeof data;
        detail::call(function, handle_.get(), &data);
        return data;
    }

    detail::owner<ptl_value, ptl_value_release> handle_;
};

/// How a computation differs from what the graph and the engine say.
struct compute_options {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    ptl_format format = PTL_FORMAT_AUTO;
    std::uint32_t threads = 0;
    std::optional<std::uint64_t> seed;
    std::uint64_t memory_limit = 0;
    std::uint32_t supersampling = 0;
    std::uint32_t precision = PTL_PRECISION_DEFAULT;
    bool keep_going = false;
    const cancel *stop = nullptr;
    /// Called on the thread that computes or waits; false cancels. It may throw.
    std::function<bool(const ptl_progress &)> progress;
    std::chrono::milliseconds interval{50};
};

namespace detail {

/// Carries a callback through the library: no exception of it passes a C function.
class watcher {
public:
    explicit watcher(std::function<bool(const ptl_progress &)> progress)
        : progress_(std::move(progress))
    {
    }

    /// Options for C that lead here; `this` must outlive their use.
    ptl_compute_options prepare(const compute_options &options)
    {
        ptl_compute_options prepared;
        PTL_COMPUTE_OPTIONS_INIT(&prepared);
        prepared.flags = (options.seed ? PTL_COMPUTE_SEED : 0u) |
                         (options.keep_going ? PTL_COMPUTE_KEEP_GOING : 0u);
        prepared.width = options.width;
        prepared.height = options.height;
        prepared.format = options.format;
        prepared.threads = options.threads;
        prepared.seed = options.seed.value_or(0);
        prepared.memory_limit = options.memory_limit;
        prepared.supersampling = options.supersampling;
        prepared.precision = options.precision;
        prepared.progress_interval_ms = static_cast<std::uint32_t>(options.interval.count());
        prepared.cancel = options.stop ? options.stop->get() : nullptr;
        prepared.progress = progress_ ? trampoline : nullptr;
        prepared.user_data = this;
        return prepared;
    }

    /// Throws what the callback threw.
    void rethrow()
    {
        if (thrown_) {
            std::rethrow_exception(std::exchange(thrown_, nullptr));
        }
    }

private:
    static std::int32_t PTL_CALL trampoline(const ptl_progress *progress, void *user_data) noexcept
    {
        auto *self = static_cast<watcher *>(user_data);
        try {
            return self->progress_(*progress) ? 0 : 1;
        } catch (...) {
            self->thrown_ = std::current_exception();
            return 1;
        }
    }

    std::function<bool(const ptl_progress &)> progress_;
    std::exception_ptr thrown_;
};

/// Carries bands to a function of the caller, and what it throws back.
template <class OnBand>
struct band_taker {
    OnBand &on_band;
    std::exception_ptr thrown;

    static std::int32_t PTL_CALL take(const ptl_band *band, void *user_data) noexcept
    {
        auto *self = static_cast<band_taker *>(user_data);
        try {
            return self->on_band(*band) ? 0 : 1;
        } catch (...) {
            self->thrown = std::current_exception();
            return 1;
        }
    }
};

} // namespace detail

/// A computation on a thread of its own. Its end cancels it.
class job {
public:
    job(ptl_job *handle, std::unique_ptr<detail::watcher> watcher)
        : watcher_(std::move(watcher)), handle_(handle)
    {
    }

    /// Whether it has ended, and how far it is.
    bool poll(ptl_progress *progress = nullptr) const
    {
        if (progress != nullptr) {
            progress->struct_size = sizeof *progress;
        }
        const ptl_status status = ptl_job_poll(handle_.get(), progress);
        if (status != PTL_PENDING) {
            detail::check(status);
        }
        return status == PTL_OK;
    }

    /// The image, once it is done.
    image wait() { return *wait_for(std::chrono::milliseconds(-1)); }

    /// The image, if it is done within that time.
    std::optional<image> wait_for(std::chrono::milliseconds timeout)
    {
        ptl_error *reason = nullptr;
        ptl_image *result = nullptr;
        const ptl_status status = ptl_job_wait(handle_.get(), timeout.count(), &result, &reason);
        const detail::error_owner owned(reason);
        watcher_->rethrow();
        if (status == PTL_PENDING) {
            return std::nullopt;
        }
        if (status != PTL_OK) {
            detail::raise(status, reason);
        }
        return image(result);
    }

    ptl_job *get() const noexcept { return handle_.get(); }

private:
    std::unique_ptr<detail::watcher> watcher_;
    detail::owner<ptl_job, ptl_job_release> handle_;
};

/// One block type of an engine; it lives as long as the engine.
class block_type {
public:
    explicit block_type(const ptl_block_type *handle) : handle_(handle) {}

    std::string id() const { return detail::text(ptl_block_type_id(handle_)); }
    std::string name() const { return detail::text(ptl_block_type_name(handle_)); }
    std::string category() const { return detail::text(ptl_block_type_category(handle_)); }
    std::string doc() const { return detail::text(ptl_block_type_doc(handle_)); }
    std::string plugin() const { return detail::text(ptl_block_type_plugin(handle_)); }
    /// PTL_BLOCK_... flags.
    std::uint32_t flags() const { return ptl_block_type_flags(handle_); }

    std::vector<ptl_param_info> params() const
    {
        return list<ptl_param_info>(ptl_block_type_param_count, ptl_block_type_param_info);
    }
    std::vector<ptl_port_info> inputs() const
    {
        return list<ptl_port_info>(ptl_block_type_input_count, ptl_block_type_input_info);
    }
    std::vector<ptl_port_info> outputs() const
    {
        return list<ptl_port_info>(ptl_block_type_output_count, ptl_block_type_output_info);
    }

    const ptl_block_type *get() const noexcept { return handle_; }

private:
    template <typename Info, typename Count, typename Fill>
    std::vector<Info> list(Count count, Fill fill) const
    {
        std::vector<Info> infos(count(handle_));
        std::uint32_t index = 0;
        for (Info &info : infos) {
            info.struct_size = sizeof info;
            detail::check(fill(handle_, index++, &info));
        }
        return infos;
    }

    const ptl_block_type *handle_;
};

/// A texture: blocks and their connections.
class graph {
public:
    explicit graph(ptl_graph *handle) : handle_(handle) {}

    /// A second owner of the same graph.
    graph retain() const { return graph(ptl_graph_retain(handle_.get())); }

    /// A graph of its own with the same contents.
    graph clone() const
    {
        ptl_graph *copy = nullptr;
        detail::call(ptl_graph_clone, handle_.get(), &copy);
        return graph(copy);
    }

    /// The graph as the contents of a file.
    std::string save() const
    {
        ptl_bytes *bytes = nullptr;
        detail::call(ptl_graph_save, handle_.get(), &bytes);
        return detail::take(bytes);
    }

    ptl_graph_info info() const
    {
        ptl_graph_info info = {};
        info.struct_size = sizeof info;
        detail::call(ptl_graph_get_info, handle_.get(), &info);
        return info;
    }

    void set_size(std::uint32_t width, std::uint32_t height)
    {
        detail::call(ptl_graph_set_size, handle_.get(), width, height);
    }
    void set_seed(std::uint64_t seed) { detail::call(ptl_graph_set_seed, handle_.get(), seed); }
    void set_supersampling(std::uint32_t level)
    {
        detail::call(ptl_graph_set_supersampling, handle_.get(), level);
    }
    void set_precision(std::uint32_t precision)
    {
        detail::call(ptl_graph_set_precision, handle_.get(), precision);
    }
    void set_folder(const std::string &folder)
    {
        detail::call(ptl_graph_set_folder, handle_.get(), folder.c_str());
    }

    /// What the file that it was read from says and the graph does not follow.
    std::vector<fault> warnings() const
    {
        std::vector<fault> warnings;
        for (std::uint32_t i = 0; i < ptl_graph_warning_count(handle_.get()); i++) {
            ptl_fault one = {};
            one.struct_size = sizeof one;
            detail::check(ptl_graph_warning_at(handle_.get(), i, &one));
            warnings.emplace_back(one);
        }
        return warnings;
    }

    ptl_block add(const std::string &type)
    {
        ptl_block block = 0;
        detail::call(ptl_graph_add_block, handle_.get(), type.c_str(), &block);
        return block;
    }
    void remove(ptl_block block) { detail::call(ptl_graph_remove_block, handle_.get(), block); }

    void connect(ptl_block source, ptl_block target, std::uint32_t input = 0,
                 std::uint32_t output = 0)
    {
        detail::call(ptl_graph_connect, handle_.get(), source, output, target, input);
    }
    void disconnect(ptl_block target, std::uint32_t input)
    {
        detail::call(ptl_graph_disconnect, handle_.get(), target, input);
    }

    /// The block that an input is connected to, and which of its outputs.
    std::optional<std::pair<ptl_block, std::uint32_t>> source(ptl_block target,
                                                              std::uint32_t input) const
    {
        ptl_block block = 0;
        std::uint32_t output = 0;
        detail::call(ptl_graph_input_source, handle_.get(), target, input, &block, &output);
        return block != 0 ? std::optional(std::pair(block, output)) : std::nullopt;
    }

    void set_float(ptl_block block, const std::string &param, double value)
    {
        detail::call(ptl_graph_set_float, handle_.get(), block, param.c_str(), &value, 1u);
    }
    void set_int(ptl_block block, const std::string &param, std::int64_t value)
    {
        detail::call(ptl_graph_set_int, handle_.get(), block, param.c_str(), value);
    }
    void set_text(ptl_block block, const std::string &param, const std::string &text)
    {
        detail::call(ptl_graph_set_text, handle_.get(), block, param.c_str(), text.c_str());
    }
    double get_float(ptl_block block, const std::string &param) const
    {
        double value = 0;
        detail::call(ptl_graph_get_float, handle_.get(), block, param.c_str(), &value, 1u, nullptr);
        return value;
    }
    std::int64_t get_int(ptl_block block, const std::string &param) const
    {
        std::int64_t value = 0;
        detail::call(ptl_graph_get_int, handle_.get(), block, param.c_str(), &value);
        return value;
    }
    std::string get_text(ptl_block block, const std::string &param) const
    {
        ptl_bytes *bytes = nullptr;
        detail::call(ptl_graph_get_text, handle_.get(), block, param.c_str(), &bytes);
        return detail::take(bytes);
    }
    void reset(ptl_block block, const std::string &param)
    {
        detail::call(ptl_graph_reset_param, handle_.get(), block, param.c_str());
    }
    /// Gives a block its own seed, or the graph's again.
    void set_block_seed(ptl_block block, std::optional<std::uint64_t> seed)
    {
        if (seed) {
            detail::call(ptl_graph_set_block_seed, handle_.get(), block, *seed);
        } else {
            detail::call(ptl_graph_reset_block_seed, handle_.get(), block);
        }
    }
    /// The seed of a block: its own, or the graph's.
    std::uint64_t block_seed(ptl_block block) const
    {
        std::uint64_t seed = 0;
        detail::call(ptl_graph_get_block_seed, handle_.get(), block, &seed, nullptr);
        return seed;
    }

    std::vector<ptl_block> blocks() const
    {
        std::vector<ptl_block> blocks(ptl_graph_block_count(handle_.get()));
        std::uint32_t index = 0;
        for (ptl_block &block : blocks) {
            block = ptl_graph_block_at(handle_.get(), index++);
        }
        return blocks;
    }
    /// The block of that id in the graph's file, or 0.
    ptl_block find(const std::string &file_id) const
    {
        return ptl_graph_find_block(handle_.get(), file_id.c_str());
    }
    /// The first input of the graph of that name, or 0.
    ptl_block find_input(const std::string &name) const
    {
        return ptl_graph_find_input(handle_.get(), name.c_str());
    }
    /// Sets the value of an input of the graph.
    void set_input(ptl_block block, const value &input)
    {
        detail::call(ptl_graph_set_input, handle_.get(), block, input.get());
    }
    /// Takes it back: then its default counts.
    void clear_input(ptl_block block)
    {
        detail::call(ptl_graph_set_input, handle_.get(), block, nullptr);
    }
    /// The last block of type "end", or 0.
    ptl_block main_result() const { return ptl_graph_main_result(handle_.get()); }
    /// The id of a block in the graph's file.
    std::string id(ptl_block block) const
    {
        ptl_bytes *bytes = nullptr;
        detail::call(ptl_graph_block_id, handle_.get(), block, &bytes);
        return detail::take(bytes);
    }
    /// The id of a block's type, also of an unknown type.
    std::string type_id(ptl_block block) const
    {
        ptl_bytes *bytes = nullptr;
        detail::call(ptl_graph_block_type_id, handle_.get(), block, &bytes);
        return detail::take(bytes);
    }
    block_type type(ptl_block block) const
    {
        const ptl_block_type *type = nullptr;
        detail::call(ptl_graph_block_type, handle_.get(), block, &type);
        return block_type(type);
    }

    void validate(ptl_block block) const
    {
        detail::call(ptl_graph_validate, handle_.get(), block);
    }

    image compute(ptl_block block, const compute_options &options = {},
                  std::uint32_t output = 0) const
    {
        detail::watcher watcher(options.progress);
        const ptl_compute_options prepared = watcher.prepare(options);
        ptl_image *result = nullptr;
        ptl_error *reason = nullptr;
        const ptl_status status =
            ptl_graph_compute(handle_.get(), block, output, &prepared, &result, &reason);
        finish(watcher, status, reason);
        return image(result);
    }

    /// Computes an output of any kind.
    value compute_value(ptl_block block, const compute_options &options = {},
                        std::uint32_t output = 0) const
    {
        detail::watcher watcher(options.progress);
        const ptl_compute_options prepared = watcher.prepare(options);
        ptl_value *result = nullptr;
        ptl_error *reason = nullptr;
        const ptl_status status =
            ptl_graph_compute_value(handle_.get(), block, output, &prepared, &result, &reason);
        finish(watcher, status, reason);
        return value(result);
    }

    /// Computes into pixels of yours; a stride of 0 is rows without gaps.
    void compute_into(ptl_block block, const compute_options &options, void *pixels,
                      std::size_t size, std::size_t row_stride = 0, std::uint32_t output = 0) const
    {
        detail::watcher watcher(options.progress);
        const ptl_compute_options prepared = watcher.prepare(options);
        ptl_error *reason = nullptr;
        const ptl_status status = ptl_graph_compute_into(handle_.get(), block, output, &prepared,
                                                         pixels, size, row_stride, &reason);
        finish(watcher, status, reason);
    }

    /// Computes and hands the result to `on_band(const ptl_band &)`, band by band from the top; it
    /// returns whether to go on, and may throw. 0 rows: as many as serve well.
    template <class OnBand>
    void compute_bands(ptl_block block, OnBand &&on_band, const compute_options &options = {},
                       std::uint32_t band_rows = 0, std::uint32_t output = 0) const
    {
        detail::watcher watcher(options.progress);
        const ptl_compute_options prepared = watcher.prepare(options);
        detail::band_taker<std::remove_reference_t<OnBand>> taker{on_band, nullptr};
        ptl_error *reason = nullptr;
        const ptl_status status =
            ptl_graph_compute_bands(handle_.get(), block, output, &prepared, band_rows,
                                    &decltype(taker)::take, &taker, &reason);
        if (taker.thrown) {
            const detail::error_owner owned(reason);
            std::rethrow_exception(taker.thrown);
        }
        finish(watcher, status, reason);
    }

    /// Lets the blocks of type "save file" write, below the engine's write_folders.
    void write_files(const compute_options &options = {}) const
    {
        detail::watcher watcher(options.progress);
        const ptl_compute_options prepared = watcher.prepare(options);
        ptl_error *reason = nullptr;
        const ptl_status status = ptl_graph_write_files(handle_.get(), &prepared, &reason);
        finish(watcher, status, reason);
    }

    job start(ptl_block block, const compute_options &options = {}, std::uint32_t output = 0) const
    {
        auto watcher = std::make_unique<detail::watcher>(options.progress);
        const ptl_compute_options prepared = watcher->prepare(options);
        ptl_job *started = nullptr;
        detail::call(ptl_graph_compute_start, handle_.get(), block, output, &prepared, &started);
        return job(started, std::move(watcher));
    }

    ptl_graph *get() const noexcept { return handle_.get(); }

private:
    static void finish(detail::watcher &watcher, ptl_status status, ptl_error *reason)
    {
        const detail::error_owner owned(reason);
        if (status != PTL_OK) {
            watcher.rethrow();
            detail::raise(status, reason);
        }
    }

    detail::owner<ptl_graph, ptl_graph_release> handle_;
};

/// How an engine is made: the C options and lists of folders. Fields that are 0 mean "as usual".
struct engine_options {
    ptl_engine_options base = {};
    std::vector<std::string> read_folders;
    std::vector<std::string> write_folders;
};

/// What computations share.
class engine {
public:
    explicit engine(const engine_options &options = {})
    {
        const auto read = pointers(options.read_folders);
        const auto write = pointers(options.write_folders);
        ptl_engine_options prepared = options.base;
        prepared.struct_size = sizeof prepared;
        prepared.read_folders = read.data();
        prepared.read_folder_count = static_cast<std::uint32_t>(read.size());
        prepared.write_folders = write.data();
        prepared.write_folder_count = static_cast<std::uint32_t>(write.size());
        ptl_engine *handle = nullptr;
        detail::call(ptl_engine_create, &prepared, &handle);
        handle_.reset(handle);
    }

    /// A second owner of the same engine.
    engine retain() const { return engine(ptl_engine_retain(handle_.get())); }

    /// Sends messages of at least `min_level` to `log`, which may run on any thread; what it
    /// throws is dropped.
    void set_log(std::int32_t min_level, std::function<void(std::int32_t, std::string_view)> log)
    {
        if (!log) {
            detail::call(ptl_engine_set_log, handle_.get(), min_level, nullptr, nullptr, nullptr);
            return;
        }
        auto kept = std::make_unique<log_function>(std::move(log));
        detail::call(ptl_engine_set_log, handle_.get(), min_level, log_trampoline,
                     static_cast<void *>(kept.get()), log_release);
        kept.release(); // the engine has it now and gives it to log_release
    }

    graph new_graph() const
    {
        ptl_graph *created = nullptr;
        detail::call(ptl_graph_create, handle_.get(), &created);
        return graph(created);
    }
    /// Reads the contents of a graph file.
    graph load(std::string_view contents) const
    {
        ptl_graph *loaded = nullptr;
        detail::call(ptl_graph_load, handle_.get(), contents.data(), contents.size(), &loaded);
        return graph(loaded);
    }
    graph load_file(const std::string &path) const
    {
        ptl_graph *loaded = nullptr;
        detail::call(ptl_graph_load_file, handle_.get(), path.c_str(), &loaded);
        return graph(loaded);
    }

    std::vector<block_type> block_types() const
    {
        std::vector<block_type> types;
        for (std::uint32_t i = 0; i < ptl_engine_block_type_count(handle_.get()); i++) {
            types.emplace_back(ptl_engine_block_type_at(handle_.get(), i));
        }
        return types;
    }
    std::optional<block_type> find_block_type(const std::string &id) const
    {
        const ptl_block_type *found = ptl_engine_find_block_type(handle_.get(), id.c_str());
        return found ? std::optional<block_type>(block_type(found)) : std::nullopt;
    }

    /// Loads a plug-in from a file; runs code of the file.
    void load_plugin(const std::string &path)
    {
        detail::call(ptl_engine_load_plugin, handle_.get(), path.c_str());
    }

    /// Loads every plug-in of some folders, separated as in PATH, or of the usual ones. `report`
    /// hears of each file; false ends the search. What it throws comes out of here.
    template <class Report>
    void scan_plugins(Report report, const std::optional<std::string> &folders = std::nullopt)
    {
        scan<Report> state{report, nullptr};
        try {
            detail::call(ptl_engine_scan_plugins, handle_.get(),
                         folders ? folders->c_str() : nullptr, scan<Report>::trampoline, &state);
        } catch (...) {
            if (state.thrown) {
                std::rethrow_exception(state.thrown);
            }
            throw;
        }
    }

    /// Adds the block types of a plug-in that is linked into the program.
    void register_plugin(const struct ptlp_entry &entry)
    {
        detail::call(ptl_engine_register_plugin, handle_.get(), &entry);
    }

    ptl_engine *get() const noexcept { return handle_.get(); }

private:
    explicit engine(ptl_engine *handle) : handle_(handle) {}

    template <class Report> struct scan {
        Report &report;
        std::exception_ptr thrown;

        static std::int32_t PTL_CALL trampoline(const ptl_scan_report *told,
                                                void *user_data) noexcept
        {
            scan &self = *static_cast<scan *>(user_data);
            try {
                return self.report(*told) ? 0 : 1;
            } catch (...) {
                self.thrown = std::current_exception();
                return 1;
            }
        }
    };

    using log_function = std::function<void(std::int32_t, std::string_view)>;

    static void PTL_CALL log_trampoline(std::int32_t level, const char *message,
                                        void *user_data) noexcept
    {
        try {
            (*static_cast<log_function *>(user_data))(level, message);
        } catch (...) { // nobody waits for it
        }
    }

    static void PTL_CALL log_release(void *user_data) noexcept
    {
        delete static_cast<log_function *>(user_data);
    }

    static std::vector<const char *> pointers(const std::vector<std::string> &texts)
    {
        std::vector<const char *> pointers;
        for (const std::string &text : texts) {
            pointers.push_back(text.c_str());
        }
        return pointers;
    }

    detail::owner<ptl_engine, ptl_engine_release> handle_;
};

} // namespace ptlib

#endif // PTLIB_HPP
