// A plug-in in C++ whose blocks throw wherever they can.
#include <new>
#include <stdexcept>

#include <ptlib/ptlib_plugin.hpp>

namespace {

namespace pp = ptlib::plugin;

enum class place { nowhere, prepare, compute, task };
constexpr const char *place_ids[] = {"nowhere", "prepare", "compute", "task"};
enum class what {
    runtime_error,
    number,
    bad_alloc,
    block_error,
    cancelled,
    wrong_type,
    wrong_place
};
constexpr const char *what_ids[] = {"runtime error", "int",       "bad alloc",  "block error",
                                    "cancelled",     "wrong type", "wrong place"};

void raise(what kind, const pp::setup *setup)
{
    switch (kind) {
    case what::runtime_error: throw std::runtime_error("the paint is dry");
    case what::number: throw 42;
    case what::bad_alloc: throw std::bad_alloc();
    case what::block_error: throw pp::block_error::limit("seven of nine");
    case what::cancelled: throw pp::block_error::cancelled();
    case what::wrong_type:
        if (setup != nullptr) {
            setup->integer(0);
        }
        return;
    case what::wrong_place:
        if (setup != nullptr) {
            setup->integer(99);
        }
        return;
    }
}

class throws {
public:
    static constexpr auto about =
        pp::about("ptlib-cpp.throw", "Throws.").category("testing").shape(pp::shape::whole);
    static constexpr pp::output_port outputs[] = {pp::output("image", pp::planes::grey())};
    enum : std::size_t { where, kind };
    static constexpr pp::param params[] = {
        pp::choice_param("where", place_ids, place_ids).doc("Where."),
        pp::choice_param("what", what_ids, what_ids).doc("What.")};

    void prepare(const pp::setup &setup)
    {
        where_ = setup.choice<place>(where);
        kind_ = setup.choice<what>(kind);
        if (where_ == place::prepare) {
            raise(kind_, &setup);
        }
    }

    void compute(pp::call &call) const
    {
        if (where_ == place::compute) {
            raise(kind_, nullptr);
        }
        const pp::output_image out = call.output(0);
        call.parallel(out.height(), [&](std::uint32_t y) {
            if (where_ == place::task && y >= 3) {
                raise(kind_, nullptr);
            }
            for (float &value : out.row(0, y)) {
                value = 0.25f;
            }
        });
    }

private:
    place where_ = place::nowhere;
    what kind_ = what::runtime_error;
};

// What is thrown here has nobody to tell but `prepare`.
template <typename Thrown> class unmade {
public:
    static constexpr auto about = Thrown::about.category("testing");
    static constexpr pp::output_port outputs[] = {pp::output("image", pp::planes::grey())};

    unmade() { Thrown::raise(); }
    void compute(pp::call &) const {}
};

struct with_words {
    static constexpr auto about = pp::about("ptlib-cpp.unmade", "Cannot be made.");
    static void raise() { throw std::runtime_error("no brush"); }
};
struct with_number {
    static constexpr auto about = pp::about("ptlib-cpp.unmade by number", "Cannot be made.");
    static void raise() { throw 7; }
};
struct without_memory {
    static constexpr auto about = pp::about("ptlib-cpp.unmade for memory", "Cannot be made.");
    static void raise() { throw std::bad_alloc(); }
};

// Its result is there before its destructor throws.
class undead {
public:
    static constexpr auto about =
        pp::about("ptlib-cpp.undead", "Throws at its end.").category("testing");
    static constexpr pp::output_port outputs[] = {pp::output("image", pp::planes::grey())};

    ~undead() noexcept(false) { throw std::runtime_error("I am not gone"); }
    void row(const pp::row &row) const
    {
        for (float &value : row.out(0)) {
            value = 0.5f;
        }
    }
};

} // namespace

constexpr ptlp_entry ptl_plugin_entry_v1 =
    pp::entry<throws, unmade<with_words>, unmade<with_number>, unmade<without_memory>, undead>(
        "ptlib-cpp", "Throwing")
        .vendor("The tests of ptlib")
        .license("MIT OR Apache-2.0");
