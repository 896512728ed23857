// The shape of a Unity project: a haptic thread at 1,000 Hz that owns the finger, frames that own the skin, and the newest
// touch handed from one to the other. Without Unity: Main plays the part of its engine for half a second.
//
//   mcs -unsafe Palpate.cs UnityLoop.cs && mono Palpate.exe
using System;
using System.Diagnostics;
using System.Threading;
using Palpate;

/// In Unity a MonoBehaviour; its methods are called as there.
public sealed class PalpationBehaviour
{
    World world;
    Finger finger;            // the haptic thread's
    Skin skin;                // the frames'
    Place place;
    const double RadiusMm = 8;
    Thread haptics;
    volatile bool isRunning;
    Touch newest = Touch.New();
    readonly object exchange = new object();
    float[] vertices, normals, rest;
    public int[] Triangles;   // for Mesh.triangles, once
    public float DeepestM;    // of this frame, for the test
    public double MostForceN;
    public int Ticks;

    public void Awake()
    {
        world = World.Torso();
        place = world.Place("T6 right 30 mm");
        var settings = FingerSettings.Default();
        settings.RadiusMm = RadiusMm;
        finger = new Finger(world, settings);
        skin = new Skin(world);
        Triangles = world.Triangles();
        InUnity.TurnTriangles(Triangles);
        isRunning = true;
        haptics = new Thread(Haptics) { IsBackground = true, Priority = ThreadPriority.Highest };
        haptics.Start();
    }

    /// A device's callback, or a loop like this one. FixedUpdate is too slow for it: 50 Hz.
    unsafe void Haptics()
    {
        var touch = Touch.New();
        var clock = Stopwatch.StartNew();
        for (int tick = 0; isRunning; ++tick)
        {
            double deep = Math.Min(8.0, 0.04 * tick - 4.0); // here stands the device's position
            double over = RadiusMm - deep;
            fixed (double* at = place.PointMm, up = place.Normal)
                finger.Step(at[0] + over * up[0], at[1] + over * up[1], at[2] + over * up[2], ref touch);
            double force = Math.Sqrt(touch.ForceN[0] * touch.ForceN[0] + touch.ForceN[1] * touch.ForceN[1] + touch.ForceN[2] * touch.ForceN[2]);
            MostForceN = Math.Max(MostForceN, force); // here it goes to the device
            lock (exchange) newest = touch;           // held for a copy of 296 bytes, by either
            Ticks = tick + 1;
            while (clock.Elapsed.TotalMilliseconds < tick + 1) Thread.Sleep(0);
        }
    }

    /// Once a picture.
    public void Update()
    {
        Touch touch;
        lock (exchange) touch = newest;
        skin.Apply(touch);
        vertices = skin.Positions(vertices);
        normals = skin.Normals(normals);
        InUnity.FromBody(vertices); // mesh.SetVertices(vertices), mesh.SetNormals(normals)
        if (rest == null) rest = (float[])vertices.Clone();
        DeepestM = 0;
        for (int i = 2; i < vertices.Length; i += 3) DeepestM = Math.Max(DeepestM, vertices[i] - rest[i]); // Unity's z
    }

    public void OnDestroy()
    {
        isRunning = false;
        haptics.Join();
        skin.Dispose();
        finger.Dispose();
        world.Dispose();
    }
}

public static class Program
{
    static void Expect(bool holds, string what)
    {
        if (holds) return;
        Console.Error.WriteLine("not so: " + what);
        Environment.Exit(1);
    }

    static unsafe void Refusals()
    {
        try { World.Parse("[body]\nkind = 3\n", "back.toml"); Expect(false, "nonsense is refused"); }
        catch (PalpateException error) { Expect(error.Line == 2 && error.Message.StartsWith("back.toml:2"), error.Message); }
        using (var sheet = World.FromArrays(new float[] { 0, 0, 0, 100, 0, 0, 0, 100, 0 }, new[] { 0, 1, 2 }))
        {
            Expect(sheet.Facts().Triangles == 1, "one triangle");
            var finger = new Finger(sheet);
            var touch = Touch.New();
            finger.Step(20, 20, 1, ref touch);
            finger.Step(20, 20, -1, ref touch);
            Expect(touch.DepthMm > 0 && touch.ForceN[2] > 0 && touch.Normal[2] == 1, "a sheet is felt");
            finger.Step(double.NaN, 0, 0, ref touch);
            Expect(touch.Status == 1 && touch.ForceN[2] == 0, "a lost tip has no force");
            finger.Dispose();
            finger.Dispose();
        }
    }

    static void StepTime()
    {
        using (var world = World.Torso())
        using (var finger = new Finger(world))
        {
            var touch = Touch.New();
            double best = double.MaxValue;
            for (int round = 0; round < 20; ++round)
            {
                var clock = Stopwatch.StartNew();
                for (int i = 0; i < 10000; ++i) finger.Step(60, 0.001 * i, 130, ref touch);
                best = Math.Min(best, clock.Elapsed.TotalMilliseconds * 1e6 / 10000);
            }
            Console.WriteLine("a step in free space takes {0:F0} ns from C#", best);
        }
    }

    public static int Main()
    {
        Refusals();
        var behaviour = new PalpationBehaviour();
        behaviour.Awake();
        int frames = 0;
        for (var clock = Stopwatch.StartNew(); clock.Elapsed.TotalSeconds < 0.6; ++frames)
        {
            behaviour.Update();
            Thread.Sleep(16);
        }
        behaviour.OnDestroy();
        Console.WriteLine("{0}: {1} ticks, {2} frames, {3:F2} N at most, the skin {4:F1} mm in", Native.Version(), behaviour.Ticks, frames,
                          behaviour.MostForceN, behaviour.DeepestM * 1000);
        Expect(behaviour.Ticks > 100 && frames > 5, "both loops ran");
        Expect(behaviour.MostForceN > 0.5 && behaviour.DeepestM > 0.002f, "the skin is felt and follows");
        StepTime();
        return 0;
    }
}
