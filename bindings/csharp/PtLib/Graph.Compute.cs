using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.InteropServices;
using System.Threading;
using System.Threading.Tasks;
using PtLib.Native;

namespace PtLib
{
    // Computing.
    public sealed unsafe partial class Graph
    {
        /// <summary>Computes an output of a block, and waits for it.</summary>
        /// <param name="block">The block.</param>
        /// <param name="options">How; null: as the graph and the engine say.</param>
        /// <param name="progress">Hears, on this thread, what part is done, 0 to 1. What it throws
        /// ends the computation and comes out of here. May be null.</param>
        /// <param name="cancellationToken">Ends the computation, normally within milliseconds.
        /// </param>
        /// <param name="output">The number of the output.</param>
        /// <returns>The image; dispose of it.</returns>
        /// <exception cref="PtLibException">The status says what is wrong.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled.</exception>
        public Image Compute(
            Block block,
            [AllowNull] ComputeOptions options = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
        {
            IntPtr image = IntPtr.Zero, error;
            using (var graph = handle.Use())
            using (var watcher = new Watcher(progress, cancellationToken))
            {
                var native = watcher.Prepare(options);
                var status = NativeMethods.ptl_graph_compute(
                    graph.Pointer,
                    Own(block, nameof(block)),
                    Number.Unsigned(output, nameof(output)),
                    &native,
                    &image,
                    &error);
                try
                {
                    watcher.Check(status, error);
                }
                catch
                {
                    // The last report may have thrown when all was done.
                    NativeMethods.ptl_image_release(image);
                    throw;
                }
            }
            return new Image(image);
        }

        /// <summary>
        /// Computes an output of a block on another thread. The graph is copied first, which costs
        /// nothing: it may be changed at once.
        /// </summary>
        /// <param name="block">The block.</param>
        /// <param name="options">How; null: as the graph and the engine say.</param>
        /// <param name="progress">Hears what part is done, 0 to 1. It is called on the other
        /// thread; Progress&lt;double&gt; brings that to the thread that made it. May be null.
        /// </param>
        /// <param name="cancellationToken">Ends the computation, normally within milliseconds.
        /// </param>
        /// <param name="output">The number of the output.</param>
        /// <returns>The image; dispose of it.</returns>
        public Task<Image> ComputeAsync(
            Block block,
            [AllowNull] ComputeOptions options = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
        {
            var number = Own(block, nameof(block));
            var copy = Clone();
            return Task.Run(
                () =>
                {
                    using (copy)
                    {
                        return copy.Compute(
                            copy.FromHandle(number), options, progress, cancellationToken, output);
                    }
                },
                cancellationToken);
        }

        /// <summary>Computes an output of any kind.</summary>
        /// <param name="block">The block.</param>
        /// <param name="options">How; the format does not matter.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>.</param>
        /// <param name="output">The number of the output.</param>
        /// <returns>A <see cref="Mesh"/>, <see cref="Points"/>, <see cref="Strands"/>,
        /// <see cref="Text"/>, <see cref="Gradient"/> or <see cref="ImageValue"/>; dispose of it.
        /// </returns>
        public Value ComputeValue(
            Block block,
            [AllowNull] ComputeOptions options = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
        {
            IntPtr value = IntPtr.Zero, error;
            using (var graph = handle.Use())
            using (var watcher = new Watcher(progress, cancellationToken))
            {
                var native = watcher.Prepare(options);
                var status = NativeMethods.ptl_graph_compute_value(
                    graph.Pointer,
                    Own(block, nameof(block)),
                    Number.Unsigned(output, nameof(output)),
                    &native,
                    &value,
                    &error);
                try
                {
                    watcher.Check(status, error);
                }
                catch
                {
                    NativeMethods.ptl_value_release(value);
                    throw;
                }
            }
            return Value.Of(value);
        }

        /// <summary>Computes an output of a block into memory of yours; it needs less memory than
        /// <see cref="Compute"/>.</summary>
        /// <param name="block">The block.</param>
        /// <param name="pixels">Where the pixels go.</param>
        /// <param name="size">Its size in bytes.</param>
        /// <param name="options">How; give a format unless you know which one it will be.</param>
        /// <param name="rowStride">Bytes from one row to the next; 0: rows without gaps.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>.</param>
        /// <param name="output">The number of the output.</param>
        /// <exception cref="PtLibException">The memory is too small, or something else is wrong.
        /// </exception>
        public void ComputeInto(
            Block block,
            IntPtr pixels,
            long size,
            [AllowNull] ComputeOptions options = null,
            int rowStride = 0,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
        {
            IntPtr error;
            using (var graph = handle.Use())
            using (var watcher = new Watcher(progress, cancellationToken))
            {
                var native = watcher.Prepare(options);
                var status = NativeMethods.ptl_graph_compute_into(
                    graph.Pointer,
                    Own(block, nameof(block)),
                    Number.Unsigned(output, nameof(output)),
                    &native,
                    (void*)pixels,
                    (UIntPtr)Number.Unsigned(size, nameof(size)),
                    (UIntPtr)Number.Unsigned(rowStride, nameof(rowStride)),
                    &error);
                watcher.Check(status, error);
            }
        }

        /// <summary>
        /// Computes an output of a block and hands it over band by band, from the top to the
        /// bottom. The result is never in memory as a whole, so it may be larger than that.
        /// </summary>
        /// <param name="block">The block.</param>
        /// <param name="onBand">Gets each band, on this thread, and returns whether to go on. What
        /// it throws ends the computation and comes out of here.</param>
        /// <param name="options">How; null: as the graph and the engine say.</param>
        /// <param name="bandRows">Rows of a band; 0: as many as serve well.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>.</param>
        /// <param name="output">The number of the output.</param>
        /// <exception cref="PtLibException">The status says what is wrong.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled, or
        /// <paramref name="onBand"/> returned false.</exception>
        public void ComputeBands(
            Block block,
            Func<Band, bool> onBand,
            [AllowNull] ComputeOptions options = null,
            int bandRows = 0,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
        {
            if (onBand == null)
            {
                throw new ArgumentNullException(nameof(onBand));
            }
            IntPtr error;
            using (var graph = handle.Use())
            using (var watcher = new Watcher(progress, cancellationToken))
            using (var taker = new BandTaker(onBand))
            {
                var native = watcher.Prepare(options);
                var status = NativeMethods.ptl_graph_compute_bands(
                    graph.Pointer,
                    Own(block, nameof(block)),
                    Number.Unsigned(output, nameof(output)),
                    &native,
                    Number.Unsigned(bandRows, nameof(bandRows)),
                    Callbacks.Band,
                    taker.UserData,
                    &error);
                taker.Rethrow(error);
                watcher.Check(status, error);
            }
        }

        /// <summary>Computes an output of a block into an array.</summary>
        /// <typeparam name="T">A number: byte, ushort, float, or a struct of them.</typeparam>
        /// <param name="block">The block.</param>
        /// <param name="pixels">Where the pixels go.</param>
        /// <param name="options">How; give a format unless you know which one it will be.</param>
        /// <param name="rowStride">Bytes from one row to the next; 0: rows without gaps.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>.</param>
        /// <param name="output">The number of the output.</param>
        /// <exception cref="PtLibException">The array is too small, or something else is wrong.
        /// </exception>
        public void ComputeInto<T>(
            Block block,
            T[] pixels,
            [AllowNull] ComputeOptions options = null,
            int rowStride = 0,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken),
            int output = 0)
            where T : struct
        {
            using (var pinned = new Pinned<T>(pixels, nameof(pixels)))
            {
                ComputeInto(
                    block, pinned.Address, pinned.Bytes, options, rowStride, progress,
                    cancellationToken, output);
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>Computes an output of a block into a span.</summary>
        /// <typeparam name="T">A number: byte, ushort, float, or a struct of them.</typeparam>
        /// <param name="block">The block.</param>
        /// <param name="pixels">Where the pixels go.</param>
        /// <param name="options">How; give a format unless you know which one it will be.</param>
        /// <param name="rowStride">Bytes from one row to the next; 0: rows without gaps.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>.</param>
        /// <param name="output">The number of the output.</param>
        /// <exception cref="PtLibException">The span is too small, or something else is wrong.
        /// </exception>
        public void ComputeInto<T>(
            Block block,
            Span<T> pixels,
            ComputeOptions? options = null,
            int rowStride = 0,
            IProgress<double>? progress = null,
            CancellationToken cancellationToken = default,
            int output = 0)
            where T : unmanaged
        {
            fixed (T* memory = pixels)
            {
                ComputeInto(
                    block, (IntPtr)memory, (long)pixels.Length * sizeof(T), options, rowStride,
                    progress, cancellationToken, output);
            }
        }
#endif

        /// <summary>
        /// Starts computing an output of a block on a thread of the library. For programs that ask
        /// now and then how far it is, such as a game once a frame.
        /// </summary>
        /// <param name="block">The block.</param>
        /// <param name="options">How; null: as the graph and the engine say.</param>
        /// <param name="output">The number of the output.</param>
        /// <returns>The job; dispose of it.</returns>
        public Job Start(Block block, [AllowNull] ComputeOptions options = null, int output = 0)
        {
            IntPtr job, error;
            var native = (options ?? ComputeOptions.Default).ToNative();
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_compute_start(
                    graph.Pointer,
                    Own(block, nameof(block)),
                    Number.Unsigned(output, nameof(output)),
                    &native,
                    &job,
                    &error);
                Errors.Check(status, error);
            }
            return new Job(job);
        }

        /// <summary>
        /// Computes the graph and lets its blocks of type "save file" write their pictures, below
        /// <see cref="EngineOptions.WriteFolders"/>.
        /// </summary>
        /// <param name="options">How; the format does not count.</param>
        /// <param name="progress">As in <see cref="Compute"/>.</param>
        /// <param name="cancellationToken">As in <see cref="Compute"/>. Nothing is written before
        /// everything is computed.</param>
        public void WriteFiles(
            [AllowNull] ComputeOptions options = null,
            [AllowNull] IProgress<double> progress = null,
            CancellationToken cancellationToken = default(CancellationToken))
        {
            IntPtr error;
            using (var graph = handle.Use())
            using (var watcher = new Watcher(progress, cancellationToken))
            {
                var native = watcher.Prepare(options);
                var status = NativeMethods.ptl_graph_write_files(graph.Pointer, &native, &error);
                watcher.Check(status, error);
            }
        }
    }
}
