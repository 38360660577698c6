// SPDX-License-Identifier: MIT
// The pass graph. A pass is a setup, which declares what it reads, writes and creates, and an
// execute, which only issues commands. Handles are typed and versioned, so passes can be added only
// in an order that works; compile() then culls, bypasses, assigns memory by lifetime and reports
// every problem at once. The graph knows no OpenGL: an executor walks the compiled steps.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "framework/graph/resource.h"

namespace kaustik::graph {

// Base of what execute functions are handed; the executor derives its own.
class ExecuteContext {
  public:
    virtual ~ExecuteContext() = default;
};

struct PassInfo {
    std::string name;    // "stage.node", unique but for repeats (batches) of one node
    std::string reason;  // why it runs, for `explain`
};

enum class PassState { ran, bypassed, culled, skipped };

// One line of `explain` and of the report.
struct PassRecord {
    std::string name;
    PassState state = PassState::ran;
    std::string reason;
    std::size_t repeats = 1;  // passes of this name
    // What stands in for the pass where it is disabled; "" where nothing does: it is required.
    std::string bypass;
    // Names of resources that it declares, each once: what it reads, and what it creates or writes.
    // A skipped pass declares none.
    std::vector<std::string> reads = {};
    std::vector<std::string> writes = {};
};

// A resource under the name that shaders have for it: every command of the pass binds it.
enum class BindAs { sampler, image, storage };
struct Binding {
    std::string name;
    ResourceRef handle;
    BindAs as;
};

class Graph;

// What a setup function is handed: the declarations of one pass.
class PassSetup {
  public:
    // A new transient texture or buffer, written first by this pass. `name` is the full name by
    // which it can be saved and viewed ("layers.depth").
    template <class Content>
    [[nodiscard]] Texture<Content> create(const std::string& name, int width, int height,
                                          int layers = 0) {
        Texture<Content> handle;
        static_cast<ResourceRef&>(handle) =
            createResource(name, TextureDesc{width, height, Content::format, layers});
        return handle;
    }
    template <class Content>
    [[nodiscard]] Buffer<Content> createBuffer(const std::string& name, std::size_t count) {
        Buffer<Content> handle;
        static_cast<ResourceRef&>(handle) =
            createResource(name, BufferDesc{count * sizeof(Content)});
        return handle;
    }
    // Creates a resource in which the next frame finds what this one has left: zeros before the
    // first frame, and after the graph has been built anew the contents of the resource of the same
    // name and shape. What writes it last runs whenever anything of it is read.
    template <class Content>
    [[nodiscard]] Texture<Content> createPersistent(const std::string& name, int width, int height,
                                                    int layers = 0) {
        const Texture<Content> handle = create<Content>(name, width, height, layers);
        makePersistent(handle);
        return handle;
    }
    template <class Content>
    [[nodiscard]] Buffer<Content> createPersistentBuffer(const std::string& name,
                                                         std::size_t count) {
        const Buffer<Content> handle = createBuffer<Content>(name, count);
        makePersistent(handle);
        return handle;
    }
    template <class Handle>
    Handle read(const Handle& handle) {
        readResource(handle);
        return handle;
    }
    // Gives the new version. The old contents are kept: this orders the pass after their writer.
    template <class Handle>
    [[nodiscard]] Handle write(const Handle& handle) {
        Handle next = handle;
        static_cast<ResourceRef&>(next) = writeResource(handle);
        return next;
    }
    // Binding is declaring: these say what the pass does with a resource and under which name its
    // shaders know it, so that no command has to. A sampler is read; an image or a storage block
    // is what this pass has created or written, or else is only read.
    template <class Content>
    Texture<Content> sample(const std::string& name, const Texture<Content>& handle) {
        readResource(handle);
        bind(name, handle, BindAs::sampler);
        return handle;
    }
    template <class Content>
    Texture<Content> image(const std::string& name, const Texture<Content>& handle) {
        if (!isOutput(handle)) readResource(handle);
        bind(name, handle, BindAs::image);
        return handle;
    }
    template <class Content>
    Buffer<Content> storage(const std::string& name, const Buffer<Content>& handle) {
        if (!isOutput(handle)) readResource(handle);
        bind(name, handle, BindAs::storage);
        return handle;
    }
    // What every command of the pass has shaders compiled with (`#define NAME`): a variant that
    // follows from what the pass was given.
    void define(const std::string& name);
    // When this pass is disabled, readers of `output` get `input` instead, or `value` everywhere.
    // A pass that leaves an output without either is required.
    template <class Handle>
    void bypass(const Handle& output, const Handle& input) {
        bypassForward(output, input);
    }
    void bypass(const ResourceRef& output, ClearValue value);

    // Keeps the pass although no pass reads its outputs.
    void sideEffect();

  private:
    friend class Graph;
    PassSetup(Graph& graph, std::size_t pass) : graph_(graph), pass_(pass) {}
    ResourceRef createResource(const std::string& name, ResourceDesc desc);
    void makePersistent(const ResourceRef& handle);
    void readResource(const ResourceRef& handle);
    ResourceRef writeResource(const ResourceRef& handle);
    void bypassForward(const ResourceRef& output, const ResourceRef& input);
    [[nodiscard]] bool isOutput(const ResourceRef& handle) const;
    void bind(const std::string& name, const ResourceRef& handle, BindAs as);

    Graph& graph_;
    std::size_t pass_;
};

// A physical texture or buffer that resources with disjoint lifetimes share.
struct Slot {
    ResourceDesc desc;
    std::string firstName;      // of the resource that lives in it first, for debug labels
    bool isPersistent = false;  // it is that resource's alone, from frame to frame
};

struct Step {
    std::string name;
    std::function<void(ExecuteContext&)> execute;  // empty: only clears
    // What the pass has declared, and so may use.
    std::vector<ResourceRef> reads;
    std::vector<ResourceRef> outputs;
    std::vector<Binding> bindings;
    std::vector<std::string> defines;
    struct Clear {
        std::size_t slot;
        ClearValue value;
    };
    std::vector<Clear> clears;                // neutral outputs of a bypassed pass
    std::vector<std::size_t> undefinedSlots;  // slots whose contents are undefined before this step
    // Slots of `undefinedSlots` that a loop around this step hands on from one run to the next.
    std::vector<std::size_t> carriedSlots;
    // Slots of `undefinedSlots` that live to the end of the frame. They are zeros before the first
    // frame, and so is therefore what a pass leaves unwritten, such as the rest of a list's
    // texture.
    std::vector<std::size_t> keptSlots;
    std::size_t liveTextureBytes = 0;  // of what has contents that are of use during it
    std::size_t liveBufferBytes = 0;
};

// Steps that run again as long as a word of a buffer is not 0 after the last of them.
struct Loop {
    std::size_t first = 0;  // steps
    std::size_t last = 0;
    ResourceRef again;
    std::size_t slot = 0;  // of that
    std::size_t word = 0;
    // Steps of the loop that would make the same again each time, and so run once.
    std::set<std::size_t> invariant;
    // A run with nothing left to do changes nothing.
    bool mayRunIdle = false;
};

struct Compiled {
    std::vector<Step> steps;
    std::vector<Loop> loops;  // an inner one before those around it
    std::vector<Slot> slots;
    std::vector<PassRecord> records;  // in graph order, left-out ones where they were declared
    std::size_t allocatedBytes = 0;   // all slots
    std::size_t peakBytes = 0;        // most that is alive during one step
    std::size_t textureBytes = 0;
    std::size_t bufferBytes = 0;
    // resource index → slot; SIZE_MAX where it is not allocated.
    std::vector<std::size_t> slotOfResource;
    struct Named {
        std::string name;
        ResourceRef handle;  // newest version
        ResourceDesc desc;
        std::size_t slot;
    };
    std::vector<Named> resources;  // everything that is alive at the end or was kept by name
    // (resource, version) → resource whose memory holds it, through bypasses; SIZE_MAX where it
    // has none.
    [[nodiscard]] std::size_t slotOf(const ResourceRef& handle) const;
    static constexpr std::size_t kNowhere = ~std::size_t{0};

    // What an execute asks for must be what its setup has declared, and of the kind that it is:
    // these give the slot, or throw a GraphError that names pass and resource.
    enum class Kind { texture, buffer };
    [[nodiscard]] std::size_t slotToUse(const Step& step, const ResourceRef& handle,
                                        Kind kind) const;
    [[nodiscard]] std::size_t slotToWrite(const Step& step, const ResourceRef& handle,
                                          Kind kind) const;
    // Whether the step may write what is behind a handle, whichever version of it that names.
    [[nodiscard]] bool writes(const Step& step, const ResourceRef& handle) const;
    // The slot after the last step of what was asked for by Graph::request(). Memory of other
    // resources may be used by others by then.
    [[nodiscard]] std::size_t slotAfterwards(const ResourceRef& handle, Kind kind) const;
    // Whether somebody has asked to read what is behind a handle after the frame.
    [[nodiscard]] bool isKept(const ResourceRef& handle) const;

  private:
    friend class Graph;
    [[nodiscard]] bool isKnown(const ResourceRef& handle) const;
    [[nodiscard]] std::size_t slotOfKind(const ResourceRef& handle, Kind kind,
                                         const std::string& user) const;
    // The name of each resource, by its index, and whether it lives until the end.
    std::vector<std::string> names_;
    std::vector<bool> isKept_;
    std::vector<std::vector<std::uint32_t>> home_;
};

class Graph {
  public:
    // Adds a pass; Data holds the handles that `execute` needs. Context is the executor's.
    //   setup(PassSetup&, Data&)      execute(const Data&, Context&)
    template <class Data, class Context, class Setup, class Execute>
    const Data& addPass(PassInfo info, Setup&& setup, Execute&& execute) {
        auto data = std::make_shared<Data>();
        const std::size_t pass = beginPass(std::move(info));
        PassSetup declarations(*this, pass);
        setup(declarations, *data);
        setExecute(pass, [data, run = std::forward<Execute>(execute)](ExecuteContext& context) {
            run(*data, static_cast<Context&>(context));
        });
        return *data;
    }

    // The passes added in between run again, in their order, as long as the `word` of `again`, a
    // buffer that one of them writes, is not 0 after the last of them. What was made before them,
    // and what is read after them, they find as their last run has left it; what only they use is
    // new each time. Passes that depend on nothing that changes run once. Loops nest.
    // `mayRunIdle`: with that word 0 already, a run changes nothing. Such a loop runs about as
    // often as in the frame before until the processor waits to read the word.
    void beginLoop();
    void endLoop(const ResourceRef& again, std::size_t word = 0, bool mayRunIdle = false);

    // Records a node that the scene does not need, with the reason, for `explain`.
    void skip(std::string name, std::string reason);

    // Asks for a resource: it and all that leads to it runs, and it lives until the end. `what`
    // names it in the error where no pass has made it.
    void request(const ResourceRef& handle, const std::string& what = "a resource");
    // Keeps every resource alive until the end (to view or scan), without asking for its passes.
    void keepAll() { keepAll_ = true; }

    // The named passes do not run; their bypasses stand in.
    void disable(const std::string& passName) { disabled_.insert(passName); }

    // Throws GraphError with every problem found, one a line.
    [[nodiscard]] Compiled compile() const;

    // The name of a resource, and all names. A handle that no pass has made is a GraphError, here
    // and in descOf.
    [[nodiscard]] const std::string& nameOf(const ResourceRef& handle) const;
    // find() and messages know it by this name from now on, which no other may have.
    void rename(const ResourceRef& handle, std::string name);
    [[nodiscard]] std::vector<std::string> resourceNames() const;
    [[nodiscard]] const ResourceDesc& descOf(const ResourceRef& handle) const;
    // The newest version of the named resource; invalid if there is none.
    [[nodiscard]] ResourceRef find(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> passNames() const;

    // Graphviz; culled passes are grey, bypassed ones dashed.
    [[nodiscard]] std::string toDot() const;

  private:
    friend class PassSetup;

    struct Bypass {
        ResourceRef output;
        ResourceRef input;  // invalid: `value`
        ClearValue value{};
    };
    struct Pass {
        PassInfo info;
        std::vector<ResourceRef> reads;
        std::vector<ResourceRef> outputs;  // created (version 0) or written (version + 1)
        std::vector<Binding> bindings;
        std::vector<std::string> defines;
        std::vector<Bypass> bypasses;
        bool hasSideEffect = false;
        bool isSkipped = false;
        std::function<void(ExecuteContext&)> execute;
    };
    struct Resource {
        std::string name;
        ResourceDesc desc;
        std::vector<std::size_t> writers;  // pass of each version
        bool isPersistent = false;
    };
    struct PassLoop {
        std::size_t first;  // passes
        std::size_t end;    // behind its last
        ResourceRef again;
        std::size_t word;
        bool mayRunIdle;
        [[nodiscard]] bool holds(std::size_t pass) const { return pass >= first && pass < end; }
    };
    struct LiveRange;
    struct Plan;

    std::size_t beginPass(PassInfo info);
    void setExecute(std::size_t pass, std::function<void(ExecuteContext&)> execute);
    bool check(const ResourceRef& handle, std::size_t pass, const char* verb);
    bool checkBypassed(const ResourceRef& output, std::size_t pass);
    [[nodiscard]] bool isMade(const ResourceRef& handle) const;
    [[nodiscard]] const Resource& resourceOf(const ResourceRef& handle) const;
    [[nodiscard]] Plan plan() const;
    void planRequired(Plan& plan) const;
    [[nodiscard]] bool needNextRun(Plan& plan, const PassLoop& loop) const;
    void placeLoops(const Plan& plan, const std::vector<std::size_t>& passOfStep,
                    Compiled& compiled) const;
    [[nodiscard]] std::set<std::size_t> invariantOf(const Plan& plan, const PassLoop& loop) const;
    static void extendLiveRanges(const Compiled& compiled, std::vector<LiveRange>& liveRanges);
    void planBypasses(Plan& plan) const;
    [[nodiscard]] std::string bypassText(const Pass& pass) const;
    void fillRecords(const Plan& plan, Compiled& compiled) const;
    void assignSlots(const Plan& plan, Compiled& compiled) const;

    std::vector<Pass> passes_;
    std::vector<Resource> resources_;
    std::unordered_map<std::string, std::size_t> resourceOfName_;
    std::vector<ResourceRef> requested_;
    std::vector<PassLoop> loops_;         // ended ones, an inner one before those around it
    std::vector<std::size_t> openLoops_;  // their first passes
    std::set<std::string> disabled_;
    std::vector<std::string> problems_;
    bool keepAll_ = false;
};

}  // namespace kaustik::graph
