/*
 * ptlib_plugin.hpp: blocks for ptlib from plug-ins in C++17, on top of ptlib_plugin.h. Header only.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * A block is a class with a description, ports, parameters, and what it computes:
 *
 *     namespace pp = ptlib::plugin;
 *
 *     class threshold {
 *     public:
 *         static constexpr auto about =
 *             pp::about("acme.threshold", "Black where an image is below a level.");
 *         static constexpr pp::input_port inputs[] = {pp::input("image", pp::kind::image)};
 *         static constexpr pp::output_port outputs[] = {
 *             pp::output("image", pp::planes::as_input(0))};
 *         enum : std::size_t { level };
 *         static constexpr pp::param params[] = {pp::float_param("level", 0.5).hard(0, 1)};
 *
 *         void prepare(const pp::setup &setup) { level_ = setup.number_f(level); }
 *         void row(const pp::row &row) const; // writes one row, or:
 *         void compute(pp::call &call) const; // writes all that `call` asks for
 *
 *     private:
 *         float level_ = 0;
 *     };
 *
 *     constexpr ptlp_entry ptl_plugin_entry_v1 =
 *         pp::entry<threshold>("acme.tools", "Tools").vendor("Acme").license("MIT");
 *
 * The life of a block in one computation: it is constructed without arguments, prepared once (if it
 * has `prepare`), computes as often as the host likes, on several threads unless `about` says
 * otherwise, and is destroyed. A Point or Gather block has `row` or `compute`, a Whole block has
 * `compute`. `static std::uint64_t memory(const setup &)` may tell the bytes that it takes.
 *
 * What is thrown never crosses the border: it becomes a status and the text that users read, with
 * the name of the block. A block_error carries its status, std::bad_alloc means
 * PTLP_E_NO_MEMORY, any other std::exception PTLP_E_FAILED with its what(), anything else
 * PTLP_E_PANIC. What the constructor throws is told when the block is prepared, what the destructor
 * throws only goes to the log.
 *
 * Everything that a block gets is borrowed until the call returns. Results may depend on
 * parameters, seed, size, precision and inputs only, and have the same bits on every platform: take
 * transcendental functions from `math`, random numbers from `noise`, and compile with
 * -ffp-contract=off. The rules are at the top of ptlib_plugin.h.
 */
#ifndef PTLIB_PLUGIN_HPP
#define PTLIB_PLUGIN_HPP

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <ptlib/ptlib_plugin.h>

/* Each plug-in has its own copy of everything here, whatever it is compiled with. */
#if defined(__GNUC__) && !defined(_WIN32)
#  define PTLP_PRIVATE __attribute__((visibility("hidden")))
#else
#  define PTLP_PRIVATE
#endif

namespace ptlib {
namespace plugin PTLP_PRIVATE {

/* ---------------------------------------------------------------------------------------------- */
/* Errors                                                                                         */

/// Why a block fails: a status of ptlib_plugin.h, and a sentence in what() for its user.
class block_error : public std::runtime_error {
public:
    explicit block_error(const std::string &message, ptlp_status status = PTLP_E_FAILED)
        : std::runtime_error(message), status_(status)
    {
    }

    /// Something that the block got makes no sense.
    static block_error invalid(const std::string &message)
    {
        return block_error(message, PTLP_E_INVALID_ARGUMENT);
    }
    /// This host or block cannot do that.
    static block_error unsupported(const std::string &message)
    {
        return block_error(message, PTLP_E_UNSUPPORTED);
    }
    /// A text or a file does not follow its grammar: say where, by line and column.
    static block_error parse(const std::string &message)
    {
        return block_error(message, PTLP_E_PARSE);
    }
    /// More than is allowed.
    static block_error limit(const std::string &message)
    {
        return block_error(message, PTLP_E_LIMIT);
    }
    /// An input is needed and not connected.
    static block_error unconnected(const std::string &message)
    {
        return block_error(message, PTLP_E_UNCONNECTED);
    }
    /// The host asked to stop.
    static block_error cancelled() { return block_error("", PTLP_E_CANCELLED); }

    ptlp_status status() const noexcept { return status_; }

private:
    ptlp_status status_;
};

namespace detail {

/// Throws what a function of the host failed with; the host knows the reason already.
inline void check(ptlp_status status)
{
    if (status == PTLP_E_NO_MEMORY) {
        throw std::bad_alloc();
    }
    if (status != PTLP_OK) {
        throw block_error("", status);
    }
}

/// A count for a table.
constexpr std::uint32_t count(std::size_t number) { return static_cast<std::uint32_t>(number); }

/// The host, from the first call on. There is one in a process.
inline std::atomic<const ptlp_host *> host{nullptr};

template <typename Table> const Table *find_service(const char *id) noexcept
{
    const ptlp_host *from = host.load(std::memory_order_acquire);
    return from ? static_cast<const Table *>(from->get_extension(from, id)) : nullptr;
}

/// The table of a service that ptlib always has.
template <typename Table> const Table &service(const char *id)
{
    const Table *table = find_service<Table>(id);
    if (table == nullptr) {
        throw block_error::unsupported(
            std::string("the host does not have the service \"") + id + "\"");
    }
    return *table;
}

} // namespace detail

/* ---------------------------------------------------------------------------------------------- */
/* Services that need no call                                                                     */

/// Elements that lie side by side and belong to somebody else.
template <typename T> class span {
public:
    constexpr span() = default;
    constexpr span(T *data, std::size_t size) : data_(data), size_(size) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t index) const { return data_[index]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// How much a message matters.
enum class level : std::int32_t {
    debug = PTLP_LOG_DEBUG,
    info = PTLP_LOG_INFO,
    warning = PTLP_LOG_WARNING,
    error = PTLP_LOG_ERROR
};

namespace detail {

inline void write_log(level how, const ptlp_job *job, const char *line) noexcept
{
    if (const auto *table = find_service<ptlp_log>(PTLP_LOG)) {
        table->write(host.load(), job, static_cast<std::int32_t>(how), line);
    }
}

} // namespace detail

/// Writes a line to the log of the host, outside of a call. (Inside: work::warn, work::log.)
inline void log(level how, const std::string &message) noexcept
{
    detail::write_log(how, nullptr, message.c_str());
}

/// The host's transcendental functions: the same bits on every platform. Angles are radians. For
/// loops, keep functions(), which spares the search.
namespace math {

/// The table of all functions. It lives as long as the process.
inline const ptlp_math &functions() { return detail::service<ptlp_math>(PTLP_MATH); }

inline double sin(double x) { return functions().sin(x); }
inline double cos(double x) { return functions().cos(x); }
inline double tan(double x) { return functions().tan(x); }
inline double asin(double x) { return functions().asin(x); }
inline double acos(double x) { return functions().acos(x); }
inline double atan(double x) { return functions().atan(x); }
/// The angle of the point (x, y).
inline double atan2(double y, double x) { return functions().atan2(y, x); }
inline double exp(double x) { return functions().exp(x); }
inline double exp2(double x) { return functions().exp2(x); }
inline double log(double x) { return functions().log(x); }
inline double log2(double x) { return functions().log2(x); }
inline double pow(double x, double y) { return functions().pow(x, y); }
inline double tanh(double x) { return functions().tanh(x); }
inline double cbrt(double x) { return functions().cbrt(x); }

} // namespace math

/// The host's random numbers: by place, not by order, and the same in every plug-in. For loops,
/// keep functions(), which spares the search.
namespace noise {

/// The table of all functions. It lives as long as the process.
inline const ptlp_noise &functions() { return detail::service<ptlp_noise>(PTLP_NOISE); }

/// 32 random bits of a seed and three numbers, such as an item, a part of it and a channel.
inline std::uint32_t hash(
    std::uint64_t seed, std::uint32_t item, std::uint32_t part = 0, std::uint32_t channel = 0)
{
    return functions().hash(seed, item, part, channel);
}

/// A number of [0, 1): the upper 24 bits of hash().
inline float uniform(
    std::uint64_t seed, std::uint32_t item, std::uint32_t part = 0, std::uint32_t channel = 0)
{
    return functions().uniform(seed, item, part, channel);
}

/// The noise that the blocks of PT Designer draw from, uniform on (-1, 1].
inline double elias(std::int32_t index) { return functions().elias(index); }

} // namespace noise

/* ---------------------------------------------------------------------------------------------- */
/* Descriptions                                                                                   */

/// What flows on a wire.
enum class kind : std::uint32_t {
    image = PTL_KIND_IMAGE,
    gradient = PTL_KIND_GRADIENT,
    text = PTL_KIND_TEXT,
    points = PTL_KIND_POINTS,
    mesh = PTL_KIND_MESH,
    strands = PTL_KIND_STRANDS
};

/// The planes of an output image.
class planes {
public:
    static constexpr planes grey() { return planes(PTLP_PLANES_GREY, 0); }
    /// Red, green, blue.
    static constexpr planes colour() { return planes(PTLP_PLANES_COLOUR, 0); }
    /// Red, green, blue, alpha.
    static constexpr planes colour_alpha() { return planes(PTLP_PLANES_COLOUR_ALPHA, 0); }
    /// Those of an input.
    static constexpr planes as_input(std::uint32_t input)
    {
        return planes(PTLP_PLANES_AS_INPUT, input);
    }
    /// Those of the image input that has the most.
    static constexpr planes most() { return planes(PTLP_PLANES_MOST, 0); }

private:
    friend class output_port;

    constexpr planes(std::uint32_t which, std::uint32_t input) : which_(which), input_(input) {}

    std::uint32_t which_;
    std::uint32_t input_;
};

namespace detail {

constexpr ptlp_port port(const char *id, kind what)
{
    return {sizeof(ptlp_port), static_cast<std::uint32_t>(what), 0, 0, 0, 0, id, nullptr};
}

} // namespace detail

/// An input: input().
class input_port {
public:
    constexpr input_port(const char *id, kind what) : table_(detail::port(id, what)) {}

    /// The block works without it.
    constexpr input_port optional() const { return with_flag(PTLP_PORT_OPTIONAL); }
    /// An image that is read anywhere, not only at the place that is written. `prepare` sees it,
    /// too.
    constexpr input_port anywhere() const { return with_flag(PTLP_PORT_ANYWHERE); }
    /// What it is, in one sentence.
    constexpr input_port doc(const char *sentence) const
    {
        input_port port = *this;
        port.table_.doc = sentence;
        return port;
    }

    constexpr const ptlp_port *table() const { return &table_; }

private:
    constexpr input_port with_flag(std::uint32_t flag) const
    {
        input_port port = *this;
        port.table_.flags |= flag;
        return port;
    }

    ptlp_port table_;
};

/// A required input, read at the place that is written. Its id is for ever.
constexpr input_port input(const char *id, kind what) { return input_port(id, what); }

/// An output: output().
class output_port {
public:
    constexpr output_port(const char *id, kind what) : table_(detail::port(id, what)) {}
    constexpr output_port(const char *id, planes which)
        : table_(detail::port(id, kind::image))
    {
        table_.planes = which.which_;
        table_.planes_input = which.input_;
    }

    /// Its numbers are any finite ones, not 0 to 1.
    constexpr output_port free_range() const
    {
        output_port port = *this;
        port.table_.flags |= static_cast<std::uint32_t>(PTLP_PORT_FREE_RANGE);
        return port;
    }
    /// What it is, in one sentence.
    constexpr output_port doc(const char *sentence) const
    {
        output_port port = *this;
        port.table_.doc = sentence;
        return port;
    }

    constexpr const ptlp_port *table() const { return &table_; }

private:
    ptlp_port table_;
};

/// An image that the block writes. Its id is for ever.
constexpr output_port output(const char *id, planes which) { return output_port(id, which); }
/// A value that the block makes, other than an image; only of blocks of shape Whole.
constexpr output_port output(const char *id, kind what) { return output_port(id, what); }

namespace detail {

constexpr ptlp_param param(std::uint32_t type, const char *id, double default_value)
{
    return {sizeof(ptlp_param), type, 0, 0, 0, 0, 0, 0, default_value, id, nullptr, nullptr,
            nullptr, nullptr, nullptr};
}

} // namespace detail

/// A parameter: int_param(), float_param(), flag_param(), choice_param(), text_param(),
/// read_path_param(), write_path_param().
class param {
public:
    constexpr explicit param(const ptlp_param &table) : table_(table) {}

    /// The smallest and the largest number that is allowed; a slider offers the same unless soft()
    /// says otherwise.
    constexpr param hard(double min, double max) const
    {
        param with = *this;
        with.table_.min = with.table_.soft_min = min;
        with.table_.max = with.table_.soft_max = max;
        return with;
    }
    /// Where an editor's slider starts and ends; after hard().
    constexpr param soft(double min, double max) const
    {
        param with = *this;
        with.table_.soft_min = min;
        with.table_.soft_max = max;
        return with;
    }
    /// What its number counts, such as "px".
    constexpr param unit(const char *name) const
    {
        param with = *this;
        with.table_.unit = name;
        return with;
    }
    /// What it does, in sentences: the help that users read.
    constexpr param doc(const char *sentences) const
    {
        param with = *this;
        with.table_.doc = sentences;
        return with;
    }

    constexpr const ptlp_param *table() const { return &table_; }

private:
    ptlp_param table_;
};

/// A whole number. Say its range with hard().
constexpr param int_param(const char *id, std::int32_t default_value)
{
    return param(detail::param(PTLP_PARAM_INT, id, default_value));
}

/// A finite number. Say its range with hard().
constexpr param float_param(const char *id, double default_value)
{
    return param(detail::param(PTLP_PARAM_FLOAT, id, default_value));
}

/// Yes or no.
constexpr param flag_param(const char *id, bool default_value)
{
    return param(detail::param(PTLP_PARAM_FLAG, id, default_value ? 1.0 : 0.0));
}

/// One of several alternatives: their ids, for ever, in a list that only grows at its end, and what
/// each means. Both arrays are static.
template <std::size_t N>
constexpr param choice_param(
    const char *id,
    const char *const (&ids)[N],
    const char *const (&docs)[N],
    std::uint32_t default_value = 0)
{
    ptlp_param table = detail::param(PTLP_PARAM_CHOICE, id, default_value);
    table.choice_count = detail::count(N);
    table.choice_ids = ids;
    table.choice_docs = docs;
    return param(table);
}

/// A text.
constexpr param text_param(const char *id, const char *default_text = "")
{
    ptlp_param table = detail::param(PTLP_PARAM_TEXT, id, 0);
    table.default_text = default_text;
    return param(table);
}

/// The path of a file that the block reads.
constexpr param read_path_param(const char *id, const char *default_text = "")
{
    ptlp_param table = detail::param(PTLP_PARAM_PATH, id, 0);
    table.flags = PTLP_PARAM_READS_FILE;
    table.default_text = default_text;
    return param(table);
}

/// The path of a file that the block writes.
constexpr param write_path_param(const char *id, const char *default_text = "")
{
    ptlp_param table = detail::param(PTLP_PARAM_PATH, id, 0);
    table.default_text = default_text;
    return param(table);
}

/// What one call of a block writes.
enum class shape : std::uint32_t {
    /// Any part of the image, from the same part of each input and the position.
    point = PTLP_SHAPE_POINT,
    /// Any part of the image, from whole inputs (those that are anywhere()).
    gather = PTLP_SHAPE_GATHER,
    /// Everything, from whole inputs.
    whole = PTLP_SHAPE_WHOLE
};

/// Which threads may be inside of a block type.
enum class threads : std::uint32_t {
    /// Any: computing is const, and changes nothing that is shared.
    any = PTLP_THREADS_TILES,
    /// One for each instance, which may change itself.
    instance = PTLP_THREADS_INSTANCE,
    /// One in the process: blocks that call libraries with global state.
    global = PTLP_THREADS_GLOBAL
};

/// What a block type is, apart from its ports and parameters. A Point block of version 1 unless it
/// says more.
class about {
public:
    /// The id is "vendor.name", for ever; the summary says in one sentence what it makes.
    constexpr about(const char *id, const char *summary)
        : table_{sizeof(ptlp_block), 1, PTLP_SHAPE_POINT, PTLP_THREADS_TILES, 0, 0, 0, 0, id,
                 nullptr, nullptr, summary, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                 nullptr, nullptr, nullptr, nullptr, nullptr}
    {
    }

    /// What people call it; otherwise, what stands behind the point of its id.
    constexpr about name(const char *text) const
    {
        about with = *this;
        with.table_.name = text;
        return with;
    }
    /// The family that it is listed with, such as "noise".
    constexpr about category(const char *text) const
    {
        about with = *this;
        with.table_.category = text;
        return with;
    }
    /// Counts up whenever its results change.
    constexpr about version(std::uint32_t number) const
    {
        about with = *this;
        with.table_.version = number;
        return with;
    }
    constexpr about shape(plugin::shape which) const
    {
        about with = *this;
        with.table_.shape = static_cast<std::uint32_t>(which);
        return with;
    }
    constexpr about threads(plugin::threads which) const
    {
        about with = *this;
        with.table_.thread_mode = static_cast<std::uint32_t>(which);
        return with;
    }
    /// Another seed gives another result.
    constexpr about uses_seed() const { return with_flag(PTLP_BLOCK_USES_SEED); }
    /// With the same inputs and parameters it may give something else.
    constexpr about not_deterministic() const { return with_flag(PTLP_BLOCK_NOT_DETERMINISTIC); }
    /// Why its output need not tile although its inputs do.
    constexpr about tiling_exception(const char *reason) const
    {
        about with = *this;
        with.table_.tiling_exception = reason;
        return with;
    }
    /// Which of its lengths count pixels, so that the picture depends on the resolution.
    constexpr about in_pixels(const char *lengths) const
    {
        about with = *this;
        with.table_.in_pixels = lengths;
        return with;
    }

    constexpr const ptlp_block &table() const { return table_; }

private:
    constexpr about with_flag(std::uint32_t flag) const
    {
        about with = *this;
        with.table_.flags |= flag;
        return with;
    }

    ptlp_block table_;
};

/* ---------------------------------------------------------------------------------------------- */
/* Views of what is at inputs and outputs                                                         */

namespace detail {

/// A rectangle of an image whose samples are `float` or `const float`.
template <typename Sample> class tile {
public:
    explicit tile(const ptlp_tile &table) : table_(&table) {}

    /// Planes: 1, 3 or 4.
    std::uint32_t channels() const noexcept { return table_->channels; }
    bool has_alpha() const noexcept { return table_->channels == 4; }
    /// Column and row of its left upper corner in the image.
    std::uint32_t x() const noexcept { return table_->x; }
    std::uint32_t y() const noexcept { return table_->y; }
    std::uint32_t width() const noexcept { return table_->width; }
    std::uint32_t height() const noexcept { return table_->height; }
    /// The size of the whole image.
    std::uint32_t image_width() const noexcept { return table_->image_width; }
    std::uint32_t image_height() const noexcept { return table_->image_height; }
    /// Samples from one row to the next.
    std::size_t row_stride() const noexcept { return table_->row_stride; }
    /// Whether there are samples: in `prepare`, only images that are read anywhere have them.
    bool has_samples() const noexcept { return table_->planes[0] != nullptr; }

    /// The first sample of a channel; nullptr for a channel that is not there. A grey image has its
    /// one plane as red, green and blue.
    Sample *plane(std::uint32_t channel) const noexcept
    {
        return channel < 4 ? table_->planes[channel] : nullptr;
    }

    /// A row of a channel, counted from the rectangle's top.
    span<Sample> row(std::uint32_t channel, std::uint32_t y) const
    {
        Sample *first = plane(channel);
        if (first == nullptr || y >= table_->height) {
            throw block_error(
                "there is no row " + std::to_string(y) + " of channel " + std::to_string(channel)
                + " in an image of " + std::to_string(table_->channels) + " channels and "
                + std::to_string(table_->height) + " rows");
        }
        return {first + y * table_->row_stride, table_->width};
    }

    const ptlp_tile &table() const noexcept { return *table_; }

private:
    const ptlp_tile *table_;
};

} // namespace detail

/// An image at an input: the part that belongs to the output, or the whole.
using image = detail::tile<const float>;
/// The part of an image that a block has to write.
using output_image = detail::tile<float>;

/// The number from 0 to before `size` that `place` is on a ring of that size: how blocks read
/// beyond an edge, so that their results tile.
constexpr std::uint32_t wrap(std::int64_t place, std::uint32_t size)
{
    const auto ring = static_cast<std::int64_t>(size);
    const std::int64_t rest = place % ring;
    return static_cast<std::uint32_t>(rest < 0 ? rest + ring : rest);
}

/// A colour transition.
class gradient {
public:
    explicit gradient(const ptl_gradient_data &table) : table_(&table) {}

    span<const ptl_gradient_stop> stops() const noexcept
    {
        return {table_->stops, table_->stop_count};
    }

    /// Red, green, blue at a position: constant before the first stop and after the last, linear
    /// between; the middle grey if there are no stops. The same bits as in the engine.
    std::array<float, 3> at(float position) const
    {
        const auto all = stops();
        std::size_t after = 0;
        while (after < all.size() && all[after].position <= position) {
            after++;
        }
        if (all.empty()) {
            return {128.0f / 255.0f, 128.0f / 255.0f, 128.0f / 255.0f};
        }
        const ptl_gradient_stop &from = all[after == 0 ? 0 : after - 1];
        const ptl_gradient_stop &to = all[after == all.size() ? after - 1 : after];
        const float distance = to.position - from.position;
        const float part = distance > 0 ? (position - from.position) / distance : 0.0f;
        std::array<float, 3> color = {};
        for (std::size_t channel = 0; channel < 3; channel++) {
            color[channel] = from.color[channel] * (1 - part) + to.color[channel] * part;
        }
        return color;
    }

private:
    const ptl_gradient_data *table_;
};

/// A stream of T: float or std::uint32_t, `const` at inputs.
template <typename T> class stream {
public:
    stream(const ptl_stream &table, std::uint32_t size) : table_(&table), size_(size)
    {
        const std::uint32_t type =
            std::is_same_v<std::remove_const_t<T>, float> ? PTL_STREAM_F32 : PTL_STREAM_U32;
        if (table.type != type) {
            throw block_error::invalid(
                std::string("the stream \"") + table.id + "\" holds "
                + (table.type == PTL_STREAM_F32 ? "real" : "whole") + " numbers");
        }
    }

    std::string_view id() const noexcept { return table_->id; }
    /// Elements, one for all of them included.
    std::uint32_t size() const noexcept { return size_; }
    /// Numbers of an element, 1 to 4.
    std::uint32_t components() const noexcept { return table_->components; }
    bool is_constant() const noexcept { return (table_->flags & PTL_STREAM_CONSTANT) != 0; }

    /// The numbers of an element, which is one of size().
    span<T> operator[](std::size_t index) const
    {
        using byte = std::conditional_t<std::is_const_v<T>, const char, char>;
        const std::size_t place = is_constant() ? 0 : index;
        /* What the host gives to be written is const in its struct alone. */
        auto *first = static_cast<byte *>(const_cast<void *>(table_->data));
        return {reinterpret_cast<T *>(first + place * table_->stride), table_->components};
    }

    const ptl_stream &table() const noexcept { return *table_; }

private:
    static_assert(
        std::is_same_v<std::remove_const_t<T>, float>
            || std::is_same_v<std::remove_const_t<T>, std::uint32_t>,
        "streams hold float or std::uint32_t");

    const ptl_stream *table_;
    std::uint32_t size_;
};

/// Streams of as many elements each.
class streams {
public:
    streams(const ptl_stream *const *tables, std::uint32_t count, std::uint32_t size)
        : tables_(tables), count_(count), size_(size)
    {
    }

    std::uint32_t count() const noexcept { return count_; }
    /// The description of a stream by number.
    const ptl_stream &table(std::uint32_t number) const { return *tables_[number]; }

    /// A stream by its id, such as "normal"; nothing if there is none.
    template <typename T = float> std::optional<stream<const T>> find(std::string_view id) const
    {
        for (std::uint32_t i = 0; i < count_; i++) {
            if (id == tables_[i]->id) {
                return stream<const T>(*tables_[i], size_);
            }
        }
        return std::nullopt;
    }

    /// The stream "position", of 3 numbers, which is always there.
    stream<const float> positions() const
    {
        if (const auto found = find("position")) {
            return *found;
        }
        throw block_error::invalid("there is no stream \"position\"");
    }

private:
    const ptl_stream *const *tables_;
    std::uint32_t count_;
    std::uint32_t size_;
};

/// Triangles at an input.
class mesh {
public:
    explicit mesh(const ptl_mesh_data &table) : table_(&table) {}

    std::uint32_t vertex_count() const noexcept { return table_->vertex_count; }
    std::uint32_t triangle_count() const noexcept { return table_->index_count / 3; }
    /// Numbers of vertices, three for each triangle.
    span<const std::uint32_t> indices() const noexcept
    {
        return {table_->indices, table_->index_count};
    }
    plugin::streams streams() const
    {
        return {table_->streams, table_->stream_count, table_->vertex_count};
    }
    const ptl_mesh_data &table() const noexcept { return *table_; }

private:
    const ptl_mesh_data *table_;
};

/// Points at an input.
class points {
public:
    explicit points(const ptl_points_data &table) : table_(&table) {}

    std::uint32_t point_count() const noexcept { return table_->point_count; }
    plugin::streams streams() const
    {
        return {table_->streams, table_->stream_count, table_->point_count};
    }
    const ptl_points_data &table() const noexcept { return *table_; }

private:
    const ptl_points_data *table_;
};

/// Polylines at an input.
class strands {
public:
    explicit strands(const ptl_strands_data &table) : table_(&table) {}

    std::uint32_t strand_count() const noexcept { return table_->strand_count; }
    std::uint32_t point_count() const noexcept { return table_->point_count; }
    /// Strand i has the points from entry i to before entry i + 1.
    span<const std::uint32_t> first_point() const noexcept
    {
        return {table_->first_point, std::size_t{table_->strand_count} + 1};
    }
    streams point_streams() const
    {
        return {table_->point_streams, table_->point_stream_count, table_->point_count};
    }
    streams strand_streams() const
    {
        return {table_->strand_streams, table_->strand_stream_count, table_->strand_count};
    }
    const ptl_strands_data &table() const noexcept { return *table_; }

private:
    const ptl_strands_data *table_;
};

/* ---------------------------------------------------------------------------------------------- */
/* What a block may ask of the host                                                               */

namespace detail {

/// What is at a wire, if it is of that kind.
template <typename Table> const Table *value_at(const ptlp_wire *wire, std::uint32_t what)
{
    const bool is_it = wire != nullptr && wire->kind == what;
    return is_it ? static_cast<const Table *>(wire->value) : nullptr;
}

/// Tasks, and what the one of the lowest number of those that failed threw.
template <typename Task> class tasks {
public:
    explicit tasks(Task &task) : task_(task) {}

    static ptlp_status PTLP_CALL run(void *user_data, std::uint32_t index) noexcept
    {
        auto &self = *static_cast<tasks *>(user_data);
        try {
            self.task_(index);
            return PTLP_OK;
        } catch (...) {
            try {
                const std::lock_guard<std::mutex> lock(self.mutex_);
                if (!self.thrown_ || index < self.index_) {
                    self.thrown_ = std::current_exception();
                    self.index_ = index;
                }
            } catch (...) {
                return PTLP_E_PANIC;
            }
            return PTLP_E_FAILED;
        }
    }

    /// Throws again what a task threw, or what the host says.
    void finish(ptlp_status status)
    {
        if (thrown_) {
            std::rethrow_exception(thrown_);
        }
        check(status);
    }

private:
    Task &task_;
    std::mutex mutex_;
    std::exception_ptr thrown_;
    std::uint32_t index_ = 0;
};

} // namespace detail

/// Memory of the host for the time of a call: zeroed, 64-byte aligned, freed with its owner.
template <typename T> class scratch {
public:
    scratch(const ptlp_job *job, std::size_t size) : job_(job), size_(size)
    {
        static_assert(
            std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
            "scratch memory holds plain data");
        static_assert(alignof(T) <= 64, "scratch memory is 64-byte aligned");
        if (size > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
            throw std::bad_alloc();
        }
        if (size != 0) {
            const auto &table = detail::service<ptlp_scratch>(PTLP_SCRATCH);
            data_ = static_cast<T *>(table.allocate(job, size * sizeof(T)));
            if (data_ == nullptr) {
                throw std::bad_alloc();
            }
        }
    }
    scratch(scratch &&from) noexcept
        : job_(from.job_), data_(std::exchange(from.data_, nullptr)),
          size_(std::exchange(from.size_, 0))
    {
    }
    scratch &operator=(scratch &&from) noexcept
    {
        std::swap(job_, from.job_);
        std::swap(data_, from.data_);
        std::swap(size_, from.size_);
        return *this;
    }
    ~scratch()
    {
        if (data_ != nullptr) {
            if (const auto *table = detail::find_service<ptlp_scratch>(PTLP_SCRATCH)) {
                table->release(job_, data_);
            }
        }
    }

    T *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    T *begin() const noexcept { return data_; }
    T *end() const noexcept { return data_ + size_; }
    T &operator[](std::size_t index) const { return data_[index]; }

private:
    const ptlp_job *job_;
    T *data_ = nullptr;
    std::size_t size_;
};

/// What a block may ask of the host while it is called. Its functions may be called from any
/// thread, until the call returns.
class work {
public:
    explicit work(const ptlp_job *job) : job_(job) {}

    /// Whether nobody looks at the result any more.
    bool is_cancelled() const noexcept { return job_ != nullptr && job_->is_cancelled(job_) != 0; }
    /// Goes on, or throws block_error::cancelled(). Call it every millisecond of work.
    void check() const
    {
        if (is_cancelled()) {
            throw block_error::cancelled();
        }
    }
    /// Tells which part of the work is done, 0 to 1. Of use in blocks of shape Whole.
    void report(double fraction) const noexcept
    {
        if (job_ != nullptr) {
            job_->report(job_, fraction);
        }
    }
    /// Tells the user that something is not as its author meant it.
    void warn(const std::string &message) const noexcept
    {
        if (job_ != nullptr) {
            job_->warn(job_, message.c_str());
        }
    }
    /// Writes a line to the log.
    void log(level how, const std::string &message) const noexcept
    {
        detail::write_log(how, job_, message.c_str());
    }

    /// Runs task(index) for 0 to before `count` on all threads of the computation, in any order,
    /// and waits for all. After one has thrown, no further task starts; what the one of the lowest
    /// number threw is thrown here.
    template <typename Task> void parallel(std::uint32_t count, Task &&task) const
    {
        using tasks = detail::tasks<std::remove_reference_t<Task>>;
        const auto &table = detail::service<ptlp_parallel>(PTLP_PARALLEL);
        tasks all(task);
        all.finish(table.run(job_, count, &tasks::run, &all));
    }

    /// Memory for `size` elements for the time of this call.
    template <typename T> plugin::scratch<T> scratch(std::size_t size) const
    {
        return plugin::scratch<T>(job_, size);
    }

    /// The bytes of the file that a path parameter names; they live until the call returns. In
    /// `prepare`, and in blocks of shape Whole.
    span<const unsigned char> read_file(const char *path) const
    {
        const void *data = nullptr;
        std::size_t size = 0;
        const auto &table = detail::service<ptlp_file>(PTLP_FILE);
        detail::check(table.read(job_, path, &data, &size));
        return {static_cast<const unsigned char *>(data), size};
    }
    /// Writes a whole file below a folder that the caller opened for writing. In blocks of shape
    /// Whole.
    void write_file(const char *path, const void *data, std::size_t size) const
    {
        const auto &table = detail::service<ptlp_file>(PTLP_FILE);
        detail::check(table.write(job_, path, data, size));
    }

    const ptlp_job *job() const noexcept { return job_; }

private:
    const ptlp_job *job_;
};

/// What `prepare` gets: parameters, size, seed, and the inputs that exist as wholes.
class setup : public work {
public:
    setup(const ptlp_setup &table, const ptlp_job *job) : work(job), table_(&table) {}

    /// Size of the images to make in pixels, supersampling included.
    std::uint32_t width() const noexcept { return table_->width; }
    std::uint32_t height() const noexcept { return table_->height; }
    /// The seed of the block in its graph.
    std::uint64_t seed() const noexcept { return table_->seed; }
    /// Whether values are stored as multiples of 1/255. The host does that.
    bool is_eight_bit() const noexcept { return table_->precision == PTLP_PRECISION_8BIT; }

    /// The value of a parameter, by its place in `params`.
    std::int32_t integer(std::size_t param) const
    {
        return static_cast<std::int32_t>(value(param, PTLP_PARAM_INT).integer);
    }
    double number(std::size_t param) const { return value(param, PTLP_PARAM_FLOAT).number; }
    /// The same in single precision.
    float number_f(std::size_t param) const { return static_cast<float>(number(param)); }
    bool flag(std::size_t param) const { return value(param, PTLP_PARAM_FLAG).integer != 0; }
    /// An alternative, as a number from 0 or as an enumeration in the order of the ids.
    template <typename Choice = std::uint32_t> Choice choice(std::size_t param) const
    {
        static_assert(
            std::is_enum_v<Choice> || std::is_integral_v<Choice>, "an enumeration or a number");
        return static_cast<Choice>(value(param, PTLP_PARAM_CHOICE).integer);
    }
    /// A text or a path: borrowed, NUL-terminated.
    const char *text(std::size_t param) const
    {
        const ptlp_value &any = value(param);
        if (any.type != PTLP_PARAM_PATH) {
            value(param, PTLP_PARAM_TEXT);
        }
        return any.text != nullptr ? any.text : "";
    }

    bool is_connected(std::size_t input) const { return wire(input)->kind != PTL_KIND_NONE; }
    /// The image at an input; nothing if none is connected. It has samples if it is read anywhere
    /// or the block is of shape Whole, else only its channels are known.
    std::optional<plugin::image> image(std::size_t input) const
    {
        return view<plugin::image, ptlp_tile>(input, PTL_KIND_IMAGE);
    }
    std::optional<plugin::gradient> gradient(std::size_t input) const
    {
        return view<plugin::gradient, ptl_gradient_data>(input, PTL_KIND_GRADIENT);
    }

private:
    const ptlp_value &value(std::size_t param) const
    {
        if (param >= table_->value_count) {
            throw std::out_of_range(
                "the block has " + std::to_string(table_->value_count)
                + " parameters, but was asked for number " + std::to_string(param));
        }
        return *table_->values[param];
    }
    const ptlp_value &value(std::size_t param, std::uint32_t type) const
    {
        const ptlp_value &found = value(param);
        if (found.type != type) {
            throw std::logic_error(
                "parameter " + std::to_string(param) + " is of type "
                + std::to_string(found.type) + ", but was read as type " + std::to_string(type));
        }
        return found;
    }
    const ptlp_wire *wire(std::size_t input) const
    {
        if (input >= table_->input_count) {
            throw std::out_of_range("`prepare` has no input " + std::to_string(input));
        }
        return table_->inputs[input];
    }
    template <typename View, typename Table>
    std::optional<View> view(std::size_t input, std::uint32_t what) const
    {
        const auto *table = detail::value_at<Table>(wire(input), what);
        return table ? std::optional<View>(*table) : std::nullopt;
    }

    const ptlp_setup *table_;
};

/* ---------------------------------------------------------------------------------------------- */
/* Values that a block makes                                                                      */

/// Asks for a stream of a value that is made, to be written by the block.
inline ptl_stream new_stream(
    const char *id, std::uint32_t components, std::uint32_t type = PTL_STREAM_F32)
{
    return {sizeof(ptl_stream), type, components, 0, id, nullptr, 0};
}

/// Asks for a stream that an input has, which is shared, not copied.
template <typename T> ptl_stream shared_stream(const stream<T> &from) { return from.table(); }

namespace detail {

using stream_list = std::initializer_list<ptl_stream>;

inline std::vector<const ptl_stream *> addresses(const stream_list &list)
{
    std::vector<const ptl_stream *> all;
    for (const ptl_stream &one : list) {
        all.push_back(&one);
    }
    return all;
}

inline const ptlp_values &values() { return service<ptlp_values>(PTLP_VALUES); }

/// What the host gives to be written is const in its struct alone.
inline std::uint32_t *writable(const std::uint32_t *numbers)
{
    return const_cast<std::uint32_t *>(numbers);
}

/// A stream of a value that is made, by the number that it was asked for with.
template <typename T>
stream<T> made_stream(
    const ptl_stream *const *tables, std::uint32_t count, std::size_t number, std::uint32_t size)
{
    if (number >= count) {
        throw std::out_of_range("the value has no stream " + std::to_string(number));
    }
    return stream<T>(*tables[number], size);
}

} // namespace detail

/// A mesh that is written: indices and new streams, then finish().
class new_mesh {
public:
    new_mesh(
        const work &from,
        std::uint32_t output,
        std::uint32_t vertex_count,
        std::uint32_t triangle_count,
        detail::stream_list streams)
        : job_(from.job()), output_(output)
    {
        if (triangle_count > std::numeric_limits<std::uint32_t>::max() / 3) {
            throw block_error::limit("a mesh has fewer than 1431655766 triangles");
        }
        const auto wanted = detail::addresses(streams);
        table_.struct_size = sizeof table_;
        table_.vertex_count = vertex_count;
        table_.index_count = 3 * triangle_count;
        table_.streams = wanted.data();
        table_.stream_count = detail::count(wanted.size());
        detail::check(detail::values().mesh_begin(job_, output_, &table_));
    }

    /// Numbers of vertices, three for each triangle.
    span<std::uint32_t> indices() const
    {
        return {detail::writable(table_.indices), table_.index_count};
    }
    /// A new stream, by its place in the list.
    template <typename T = float> plugin::stream<T> stream(std::size_t number) const
    {
        return detail::made_stream<T>(
            table_.streams, table_.stream_count, number, table_.vertex_count);
    }
    /// Checks it, and gives it to the output.
    void finish() const { detail::check(detail::values().finish(job_, output_)); }

private:
    const ptlp_job *job_;
    std::uint32_t output_;
    ptl_mesh_data table_ = {};
};

/// Points that are written: new streams, then finish().
class new_points {
public:
    new_points(
        const work &from,
        std::uint32_t output,
        std::uint32_t point_count,
        detail::stream_list streams)
        : job_(from.job()), output_(output)
    {
        const auto wanted = detail::addresses(streams);
        table_.struct_size = sizeof table_;
        table_.point_count = point_count;
        table_.streams = wanted.data();
        table_.stream_count = detail::count(wanted.size());
        detail::check(detail::values().points_begin(job_, output_, &table_));
    }

    /// A new stream, by its place in the list.
    template <typename T = float> plugin::stream<T> stream(std::size_t number) const
    {
        return detail::made_stream<T>(
            table_.streams, table_.stream_count, number, table_.point_count);
    }
    /// Checks them, and gives them to the output.
    void finish() const { detail::check(detail::values().finish(job_, output_)); }

private:
    const ptlp_job *job_;
    std::uint32_t output_;
    ptl_points_data table_ = {};
};

/// Strands that are written: first points and new streams, then finish().
class new_strands {
public:
    new_strands(
        const work &from,
        std::uint32_t output,
        std::pair<std::uint32_t, std::uint32_t> strand_and_point_count,
        detail::stream_list point_streams,
        detail::stream_list strand_streams = {})
        : job_(from.job()), output_(output)
    {
        const auto of_points = detail::addresses(point_streams);
        const auto of_strands = detail::addresses(strand_streams);
        table_.struct_size = sizeof table_;
        table_.strand_count = strand_and_point_count.first;
        table_.point_count = strand_and_point_count.second;
        table_.point_streams = of_points.data();
        table_.strand_streams = of_strands.data();
        table_.point_stream_count = detail::count(of_points.size());
        table_.strand_stream_count = detail::count(of_strands.size());
        detail::check(detail::values().strands_begin(job_, output_, &table_));
    }

    /// Where each strand's points start, and behind the last strand the count of points.
    span<std::uint32_t> first_point() const
    {
        return {detail::writable(table_.first_point), std::size_t{table_.strand_count} + 1};
    }
    /// A new stream of the points, and of the strands, by its place in its list.
    template <typename T = float> plugin::stream<T> point_stream(std::size_t number) const
    {
        return detail::made_stream<T>(
            table_.point_streams, table_.point_stream_count, number, table_.point_count);
    }
    template <typename T = float> plugin::stream<T> strand_stream(std::size_t number) const
    {
        return detail::made_stream<T>(
            table_.strand_streams, table_.strand_stream_count, number, table_.strand_count);
    }
    /// Checks them, and gives them to the output.
    void finish() const { detail::check(detail::values().finish(job_, output_)); }

private:
    const ptlp_job *job_;
    std::uint32_t output_;
    ptl_strands_data table_ = {};
};

/* ---------------------------------------------------------------------------------------------- */
/* Calls                                                                                          */

/// One call of `compute`: what is at the inputs, and the outputs to write.
class call : public work {
public:
    /// Wires and how many there are.
    using wires = span<const ptlp_wire *const>;

    call(const ptlp_job *job, wires inputs, wires outputs)
        : work(job), inputs_(inputs), outputs_(outputs)
    {
    }

    bool is_connected(std::size_t input) const
    {
        return input < inputs_.size() && inputs_[input]->kind != PTL_KIND_NONE;
    }

    /// What is at an input; throws block_error::unconnected() if there is no such value.
    plugin::image image(std::size_t input) const
    {
        return view<plugin::image, ptlp_tile>(input, PTL_KIND_IMAGE, "an image");
    }
    plugin::gradient gradient(std::size_t input) const
    {
        return view<plugin::gradient, ptl_gradient_data>(
            input, PTL_KIND_GRADIENT, "a colour transition");
    }
    std::string_view text(std::size_t input) const
    {
        const ptl_text_data &text = table<ptl_text_data>(input, PTL_KIND_TEXT, "a text");
        return text.size == 0 ? std::string_view() : std::string_view(text.text, text.size);
    }
    plugin::points points(std::size_t input) const
    {
        return view<plugin::points, ptl_points_data>(input, PTL_KIND_POINTS, "points");
    }
    plugin::mesh mesh(std::size_t input) const
    {
        return view<plugin::mesh, ptl_mesh_data>(input, PTL_KIND_MESH, "a mesh");
    }
    plugin::strands strands(std::size_t input) const
    {
        return view<plugin::strands, ptl_strands_data>(input, PTL_KIND_STRANDS, "strands");
    }
    /// The image at an input; nothing if none is connected.
    std::optional<plugin::image> optional_image(std::size_t input) const
    {
        if (!is_connected(input)) {
            return std::nullopt;
        }
        return image(input);
    }

    /// The image to write at an output.
    output_image output(std::size_t output) const
    {
        const ptlp_wire *wire = output < outputs_.size() ? outputs_[output] : nullptr;
        const auto *table = detail::value_at<ptlp_tile>(wire, PTL_KIND_IMAGE);
        if (table == nullptr) {
            throw std::logic_error("output " + std::to_string(output) + " is no image");
        }
        return output_image(*table);
    }

    /// Gives an output a text in UTF-8.
    void set_text(std::uint32_t output, std::string_view text) const
    {
        detail::check(detail::values().text(job(), output, text.data(), text.size()));
    }
    /// Gives an output a colour transition.
    void set_gradient(std::uint32_t output, span<const ptl_gradient_stop> stops) const
    {
        const std::uint32_t count = detail::count(stops.size());
        detail::check(detail::values().gradient(job(), output, stops.data(), count));
    }
    /// Gives an output the value of an input of the same kind, without a copy.
    void pass(std::uint32_t output, std::uint32_t input) const
    {
        detail::check(detail::values().pass(job(), output, input));
    }

private:
    template <typename Table>
    const Table &table(std::size_t input, std::uint32_t what, const char *name) const
    {
        const ptlp_wire *wire = input < inputs_.size() ? inputs_[input] : nullptr;
        const auto *found = detail::value_at<Table>(wire, what);
        if (found == nullptr) {
            throw block_error::unconnected(
                std::string("needs ") + name + " at input " + std::to_string(input));
        }
        return *found;
    }
    template <typename View, typename Table>
    View view(std::size_t input, std::uint32_t what, const char *name) const
    {
        return View(table<Table>(input, what, name));
    }

    wires inputs_;
    wires outputs_;
};

/// A row of the outputs of a Point or Gather block.
class row {
public:
    row(const plugin::call &from, const output_image &first, std::uint32_t y)
        : call_(&from), first_(&first), y_(y)
    {
    }

    /// Column of its first pixel, and its row, in the image.
    std::uint32_t x() const noexcept { return first_->x(); }
    std::uint32_t y() const noexcept { return first_->y() + y_; }
    std::uint32_t width() const noexcept { return first_->width(); }
    /// The size of the whole image.
    std::uint32_t image_width() const noexcept { return first_->image_width(); }
    std::uint32_t image_height() const noexcept { return first_->image_height(); }
    /// Planes of an output.
    std::uint32_t channels(std::size_t output = 0) const
    {
        return output == 0 ? first_->channels() : call_->output(output).channels();
    }

    /// The same row of an input that is not read anywhere.
    span<const float> in(std::size_t input, std::uint32_t channel) const
    {
        return call_->image(input).row(channel, y_);
    }
    /// The row to write.
    span<float> out(std::uint32_t channel, std::size_t output = 0) const
    {
        return output == 0 ? first_->row(channel, y_) : call_->output(output).row(channel, y_);
    }
    /// Everything else: whole inputs, gradients, whether to stop.
    const plugin::call &call() const noexcept { return *call_; }

private:
    const plugin::call *call_;
    const output_image *first_;
    std::uint32_t y_;
};

/* ---------------------------------------------------------------------------------------------- */
/* Tables                                                                                         */

namespace detail {

template <typename Block, typename = void> struct ports_in {
    static constexpr std::array<const ptlp_port *, 1> table = {nullptr};
    static constexpr std::size_t size = 0;
};
template <typename Block, typename = void> struct params_of {
    static constexpr std::array<const ptlp_param *, 1> table = {nullptr};
    static constexpr std::size_t size = 0;
};

template <typename Table, typename Item, std::size_t... I>
constexpr std::array<const Table *, sizeof...(I)> tables(
    const Item (&items)[sizeof...(I)], std::index_sequence<I...>)
{
    return {items[I].table()...};
}

template <typename Table, typename Item, std::size_t N>
constexpr std::array<const Table *, N> tables(const Item (&items)[N])
{
    return tables<Table>(items, std::make_index_sequence<N>());
}

template <typename Block> struct ports_in<Block, std::void_t<decltype(Block::inputs)>> {
    static constexpr auto table = tables<ptlp_port>(Block::inputs);
    static constexpr std::size_t size = table.size();
};
template <typename Block> struct ports_out {
    static constexpr auto table = tables<ptlp_port>(Block::outputs);
    static constexpr std::size_t size = table.size();
};
template <typename Block> struct params_of<Block, std::void_t<decltype(Block::params)>> {
    static constexpr auto table = tables<ptlp_param>(Block::params);
    static constexpr std::size_t size = table.size();
};

template <typename Block, typename = void> struct has_prepare : std::false_type {};
template <typename Block>
struct has_prepare<
    Block,
    std::void_t<decltype(std::declval<Block &>().prepare(std::declval<const setup &>()))>>
    : std::true_type {};

template <typename Block, typename = void> struct has_memory : std::false_type {};
template <typename Block>
struct has_memory<Block, std::void_t<decltype(Block::memory(std::declval<const setup &>()))>>
    : std::true_type {};

/// Whether a `Block`, which may be const, has `row`, and `compute`.
template <typename Block, typename = void> struct has_row : std::false_type {};
template <typename Block>
struct has_row<
    Block,
    std::void_t<decltype(std::declval<Block &>().row(std::declval<const row &>()))>>
    : std::true_type {};
template <typename Block, typename = void> struct has_compute : std::false_type {};
template <typename Block>
struct has_compute<
    Block,
    std::void_t<decltype(std::declval<Block &>().compute(std::declval<call &>()))>>
    : std::true_type {};

/// The status and the text of what is being thrown; only inside of a catch.
template <typename Tell> ptlp_status thrown(Tell &&tell) noexcept
{
    try {
        throw;
    } catch (const block_error &error) {
        tell(error.what());
        return error.status() == PTLP_OK ? PTLP_E_FAILED : error.status();
    } catch (const std::bad_alloc &) {
        tell("there is no memory left");
        return PTLP_E_NO_MEMORY;
    } catch (const std::exception &error) {
        tell(error.what());
        return PTLP_E_FAILED;
    } catch (...) {
        tell("threw something that is no std::exception");
        return PTLP_E_PANIC;
    }
}

/// Tells the host, unless there is nothing to say.
inline void set_error(const ptlp_job *job, const char *text) noexcept
{
    if (job != nullptr && text != nullptr && *text != '\0') {
        job->set_error(job, text);
    }
}

/// Runs a part of a block for the host.
template <typename Run> ptlp_status guarded(const ptlp_job *job, Run &&run) noexcept
{
    try {
        run();
        return PTLP_OK;
    } catch (...) {
        return thrown([job](const char *text) { set_error(job, text); });
    }
}

/// What the host holds as an instance: the block, or what its constructor threw, because `create`
/// has nobody to tell.
template <typename Block> struct slot {
    std::unique_ptr<Block> block;
    std::exception_ptr thrown;
};

/// The functions in the table of a block type.
template <typename Block> struct shims {
    static constexpr bool is_shared =
        Block::about.table().thread_mode == static_cast<std::uint32_t>(PTLP_THREADS_TILES);
    using instance = std::conditional_t<is_shared, const Block, Block>;

    static ptlp_status PTLP_CALL create(
        const ptlp_block *, const ptlp_host *from, void **place) noexcept
    {
        host.store(from, std::memory_order_release);
        auto *made = new (std::nothrow) slot<Block>();
        if (made == nullptr) {
            return PTLP_E_NO_MEMORY;
        }
        *place = made;
        try {
            made->block = std::make_unique<Block>();
        } catch (...) {
            made->thrown = std::current_exception();
        }
        return PTLP_OK;
    }

    static void PTLP_CALL destroy(void *place) noexcept
    {
        try {
            auto *made = static_cast<slot<Block> *>(place);
            Block *block = made->block.release();
            delete made;
            // Not by unique_ptr, which no exception may leave.
            delete block;
        } catch (...) {
            thrown([](const char *text) {
                // Without memory of its own: there may be none.
                char line[512];
                std::snprintf(line, sizeof line, "%s: %s", Block::about.table().id, text);
                write_log(level::error, nullptr, line);
            });
        }
    }

    static ptlp_status PTLP_CALL prepare(
        void *place, const ptlp_job *job, const ptlp_setup *table) noexcept
    {
        return guarded(job, [&] {
            auto &made = *static_cast<slot<Block> *>(place);
            if (made.thrown) {
                std::rethrow_exception(made.thrown);
            }
            if constexpr (has_prepare<Block>::value) {
                made.block->prepare(setup(*table, job));
            } else {
                static_cast<void>(table);
            }
        });
    }

    static ptlp_status PTLP_CALL compute(
        void *place,
        const ptlp_job *job,
        const ptlp_wire *const *inputs,
        const ptlp_wire *const *outputs) noexcept
    {
        return guarded(job, [&] {
            instance &block = *static_cast<slot<Block> *>(place)->block;
            call with(
                job, {inputs, ports_in<Block>::size}, {outputs, ports_out<Block>::size});
            if constexpr (has_row<instance>::value) {
                const output_image first = with.output(0);
                for (std::uint32_t y = 0; y < first.height(); y++) {
                    with.check();
                    block.row(row(with, first, y));
                }
            } else {
                block.compute(with);
            }
        });
    }

    static std::uint64_t PTLP_CALL memory(const ptlp_block *, const ptlp_setup *table) noexcept
    {
        std::uint64_t bytes = sizeof(Block);
        if constexpr (has_memory<Block>::value) {
            const auto ask = [&] { bytes += Block::memory(setup(*table, nullptr)); };
            guarded(nullptr, ask);
        } else {
            static_cast<void>(table);
        }
        return bytes;
    }

    static constexpr ptlp_block table()
    {
        static_assert(
            has_row<instance>::value != has_compute<instance>::value,
            "a block has either `row` or `compute`: `void row(const row &) const` or "
            "`void compute(call &) const`, without const only where `about` says threads::instance "
            "or threads::global");
        static_assert(
            !has_row<instance>::value
                || Block::about.table().shape != static_cast<std::uint32_t>(PTLP_SHAPE_WHOLE),
            "a block of shape Whole has `compute`");
        ptlp_block table = Block::about.table();
        table.input_count = count(ports_in<Block>::size);
        table.output_count = count(ports_out<Block>::size);
        table.param_count = count(params_of<Block>::size);
        table.inputs = ports_in<Block>::table.data();
        table.outputs = ports_out<Block>::table.data();
        table.params = params_of<Block>::table.data();
        table.create = &create;
        table.destroy = &destroy;
        table.prepare = &prepare;
        table.compute = &compute;
        table.memory = &memory;
        return table;
    }
};

/// The table of a block type; it lives as long as the process.
template <typename Block> struct block_table {
    static constexpr ptlp_block value = shims<Block>::table();
};

template <typename... Blocks> struct block_tables {
    static constexpr std::array<const ptlp_block *, sizeof...(Blocks)> value = {
        &block_table<Blocks>::value...};
};

inline ptlp_status PTLP_CALL init(const ptlp_host *from, const char *) noexcept
{
    host.store(from, std::memory_order_release);
    return PTLP_OK;
}

/* The compiler that builds the plug-in. */
#if defined(__clang__)
inline constexpr const char *built_with = "clang++ " __clang_version__;
#elif defined(__GNUC__)
inline constexpr const char *built_with = "g++ " __VERSION__;
#elif defined(_MSC_VER)
inline constexpr const char *built_with = "Microsoft Visual C++";
#else
inline constexpr const char *built_with = nullptr;
#endif

} // namespace detail

/// What a plug-in exports: entry().
class plugin_entry {
public:
    constexpr explicit plugin_entry(const ptlp_entry &table) : table_(table) {}

    /// Who made it.
    constexpr plugin_entry vendor(const char *text) const
    {
        plugin_entry with = *this;
        with.table_.vendor = text;
        return with;
    }
    /// Its version; "1.0.0" unless this says otherwise.
    constexpr plugin_entry version(const char *text) const
    {
        plugin_entry with = *this;
        with.table_.version = text;
        return with;
    }
    /// The SPDX expression of its licence.
    constexpr plugin_entry license(const char *text) const
    {
        plugin_entry with = *this;
        with.table_.license = text;
        return with;
    }

    constexpr operator ptlp_entry() const { return table_; }

private:
    ptlp_entry table_;
};

/// The entry of a plug-in with these blocks, for the definition of ptl_plugin_entry_v1. Its id is
/// the vendor of the blocks, or the vendor, a point and a word.
template <typename... Blocks> constexpr plugin_entry entry(const char *id, const char *name)
{
    static_assert(sizeof...(Blocks) > 0, "a plug-in has blocks");
    return plugin_entry(ptlp_entry{
        sizeof(ptlp_entry), PTLP_ABI_MAJOR, PTLP_ABI_MINOR, 0, id, name, id, "1.0.0", "",
        detail::built_with, &detail::init, nullptr, nullptr,
        detail::block_tables<Blocks...>::value.data(), detail::count(sizeof...(Blocks)), 0});
}

} // namespace plugin
} // namespace ptlib

#undef PTLP_PRIVATE

#endif /* PTLIB_PLUGIN_HPP */
