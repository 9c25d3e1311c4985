using System;
using System.Diagnostics.CodeAnalysis;
using System.Threading;
using System.Threading.Tasks;

namespace PtLib.Aging
{
    /// <summary>
    /// Ages heads. The plug-in "aging" has to be loaded: <see cref="Engine.LoadPlugin"/>.
    /// <para>
    /// Nothing is kept here between two calls. The engine keeps what it computed, so that another
    /// age alone costs little: wrinkles, regions and roots of hair come from its cache.
    /// </para>
    /// </summary>
    public static class AgingSim
    {
        /// <summary>The blocks that have an age.</summary>
        private static readonly string[] Aging =
        {
            "height", "normals", "living roots", "colored roots",
        };

        /// <summary>Ages a head, and waits for it.</summary>
        /// <param name="engine">The engine, with the plug-in "aging".</param>
        /// <param name="mesh">The head. It is checked before anything is computed.</param>
        /// <param name="settings">How; null: as usual.</param>
        /// <param name="progress">Hears, on this thread, what part is done, 0 to 1. What it throws
        /// ends the computation and comes out of here. May be null.</param>
        /// <param name="cancel">Ends the computation, normally within milliseconds.</param>
        /// <returns>What <see cref="AgingSettings.Outputs"/> asks for; dispose of it.</returns>
        /// <exception cref="PtLibException">Something is wrong with the mesh, the settings or a
        /// picture: the message says what and where.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled.</exception>
        public static AgingResult Run(
            Engine engine,
            AgingInputMesh mesh,
            [AllowNull] AgingSettings settings = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancel = default(CancellationToken))
        {
            var outputs = (settings ?? new AgingSettings()).Outputs;
            using (var graph = Prepare(engine, mesh, settings))
            {
                return Compute(graph, outputs, progress, cancel);
            }
        }

        /// <summary>The same on another thread. Mesh, settings and pictures are checked and copied
        /// before this returns: they may be changed at once.</summary>
        /// <param name="engine">As in <see cref="Run"/>.</param>
        /// <param name="mesh">As in <see cref="Run"/>.</param>
        /// <param name="settings">As in <see cref="Run"/>.</param>
        /// <param name="progress">As in <see cref="Run"/>, but it is called on the other thread;
        /// Progress&lt;double&gt; brings that to the thread that made it.</param>
        /// <param name="cancel">As in <see cref="Run"/>.</param>
        /// <returns>The result; dispose of it.</returns>
        /// <exception cref="PtLibException">Something is wrong with the mesh or the settings. What
        /// fails later fails the task.</exception>
        public static Task<AgingResult> RunAsync(
            Engine engine,
            AgingInputMesh mesh,
            [AllowNull] AgingSettings settings = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancel = default(CancellationToken))
        {
            var outputs = (settings ?? new AgingSettings()).Outputs;
            var graph = Prepare(engine, mesh, settings);
            var task = Task.Run(() => Compute(graph, outputs, progress, cancel), cancel);
            // Also where the task was cancelled before it began.
            task.ContinueWith(
                done => graph.Dispose(),
                CancellationToken.None,
                TaskContinuationOptions.ExecuteSynchronously,
                TaskScheduler.Default);
            return task;
        }

        /// <summary>
        /// The graph that <see cref="Run"/> computes, to edit or to save. Its input "head" needs a
        /// mesh: graph.SetInput("head", mesh.ToMesh()). <see cref="Graph.Find"/> finds its blocks
        /// by name: "head", "height", "normals", "loss age", "roots" (all hairs as points), "hair"
        /// (strands), "view", and others. Pictures that are no files, such as the default regions
        /// of hair, are inputs too, by the names "skin color", "wrinkle mask", "fine tile", "fine
        /// mask", "outer hair", "inner hair"; they are not saved with the graph.
        /// </summary>
        /// <param name="engine">The engine, with the plug-in "aging".</param>
        /// <param name="settings">How; null: as usual. What it asks for does not matter.</param>
        /// <returns>The graph; dispose of it.</returns>
        /// <exception cref="PtLibException">The plug-in is not loaded, or a setting is wrong.
        /// </exception>
        public static Graph CreateGraph(Engine engine, [AllowNull] AgingSettings settings = null)
        {
            if (engine == null)
            {
                throw new ArgumentNullException(nameof(engine));
            }
            return GraphBuilder.Build(engine, settings ?? new AgingSettings());
        }

        /// <summary>Changes the age of a graph of <see cref="CreateGraph"/>: of its wrinkles, fine
        /// ones too, and of its hair.</summary>
        /// <param name="graph">The graph.</param>
        /// <param name="age">The age, 0 to 1.</param>
        /// <exception cref="PtLibException">The age is not in 0 to 1, or the graph is another one.
        /// </exception>
        public static void SetAge(Graph graph, double age)
        {
            if (graph == null)
            {
                throw new ArgumentNullException(nameof(graph));
            }
            foreach (var name in Aging)
            {
                var block = Named(graph, name);
                // Without fine wrinkles, normals are those of the heights, which are aged.
                if (block.TypeId != "aging.height to normal")
                {
                    block.Set("age", age);
                }
            }
        }

        internal static Block Named(Graph graph, string name)
        {
            return graph.Find(name) ?? throw new PtLibException(
                Status.NotFound,
                "The graph has no block of the name \"" + name + "\".",
                nameof(graph));
        }

        /// <summary>The graph with its mesh: everything is checked.</summary>
        private static Graph Prepare(
            Engine engine, AgingInputMesh mesh, [AllowNull] AgingSettings settings)
        {
            if (engine == null)
            {
                throw new ArgumentNullException(nameof(engine));
            }
            if (mesh == null)
            {
                throw new ArgumentNullException(nameof(mesh));
            }
            using (var head = mesh.ToMesh())
            {
                var graph = CreateGraph(engine, settings);
                try
                {
                    graph.SetInput("head", head);
                    return graph;
                }
                catch
                {
                    graph.Dispose();
                    throw;
                }
            }
        }

        private static AgingResult Compute(
            Graph graph,
            AgingOutputs outputs,
            [AllowNull] IProgress<double> progress,
            CancellationToken cancel)
        {
            var computation = new Computation(graph, outputs, progress, cancel);
            var result = new AgingResult();
            try
            {
                result.Height =
                    computation.Image(AgingOutputs.Height, "height", PixelFormat.GreyFloat);
                result.Normals =
                    computation.Image(AgingOutputs.Normals, "normals", PixelFormat.RgbaFloat);
                result.LossAge =
                    computation.Image(AgingOutputs.LossAge, "loss age", PixelFormat.GreyFloat);
                // Roots before strands, which are made of them.
                using (var roots = computation.Value(AgingOutputs.Hair, "roots"))
                {
                    if (roots != null)
                    {
                        result.SetLossAges(((Points)roots).ToArray<float>("loss age"));
                    }
                }
                result.Hair = computation.Value(AgingOutputs.Hair, "hair") as Strands;
                result.View = computation.Image(AgingOutputs.View, "view", PixelFormat.Rgba8);
                return result;
            }
            catch
            {
                result.Dispose();
                throw;
            }
        }
    }
}
