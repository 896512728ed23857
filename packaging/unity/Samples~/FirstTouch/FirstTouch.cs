// The first touch: a fingertip presses the torso 30 mm beside T6 for half a second and drags for another. Forces come from a
// thread of their own, a thousand a second; the mesh follows once a picture. Put it on an empty game object and press Play.
using System;
using System.Diagnostics;
using System.Globalization;
using System.Threading;
using Palpate;
using UnityEngine;
using Debug = UnityEngine.Debug;
using Touch = Palpate.Touch; // Unity has one of its own

[RequireComponent(typeof(MeshFilter), typeof(MeshRenderer))]
public sealed class FirstTouch : MonoBehaviour
{
    const double RadiusMm = 8.0;
    const int Ticks = 1000;

    World world;
    Finger finger; // the haptic thread's
    Skin skin;     // the pictures'
    Place place;
    Thread haptics;
    volatile bool isRunning;
    readonly object exchange = new object();
    Touch newest = Touch.New();
    string report; // of the finished touch, until Update has shown it

    Mesh mesh;
    Transform tip;
    float[] positions, normals;
    Vector3[] vertices, directions;

    void Awake()
    {
        world = World.Torso();
        place = world.Place("T6 right 30 mm");
        var settings = FingerSettings.Default();
        settings.RadiusMm = RadiusMm;
        finger = new Finger(world, settings);
        skin = new Skin(world);
        MakeMesh();
        isRunning = true;
        haptics = new Thread(Feel) { IsBackground = true, Priority = System.Threading.ThreadPriority.Highest };
        haptics.Start();
    }

    /// A haptic device's callback, or a loop like this one; FixedUpdate is too slow for a hand.
    unsafe void Feel()
    {
        var touch = Touch.New();
        var clock = Stopwatch.StartNew();
        double most = 0;
        ulong hash = 14695981039346656037; // FNV-1a
        for (int tick = 0; isRunning && tick < Ticks; ++tick)
        {
            double deep = tick < 500 ? tick * 0.03125 - 8.0 : 7.625; // here stands the device's position
            double over = RadiusMm - deep;
            double along = tick < 500 ? 0.0 : 0.03125 * (tick - 500);
            fixed (double* at = place.PointMm, up = place.Normal)
                finger.Step(at[0] + over * up[0], at[1] + over * up[1] + along, at[2] + over * up[2], ref touch);
            for (int axis = 0; axis < 3; ++axis) // here the force goes to the device
            {
                ulong bits = (ulong)BitConverter.DoubleToInt64Bits(touch.ForceN[axis]);
                for (int shift = 0; shift < 64; shift += 8) hash = (hash ^ ((bits >> shift) & 255)) * 1099511628211;
            }
            most = Math.Max(most, touch.ForceN[2]);
            lock (exchange) newest = touch; // held for a copy of 296 bytes, by either
            while (isRunning && clock.Elapsed.TotalMilliseconds < tick + 1) Thread.Sleep(0);
        }
        lock (exchange)
            report = string.Format(CultureInfo.InvariantCulture, "at most {0:F2} N; hash of {1} forces {2:x16}", most, Ticks, hash);
    }

    void Update()
    {
        Touch touch;
        string said;
        lock (exchange)
        {
            touch = newest;
            said = report;
            report = null;
        }
        skin.Apply(touch);
        Show(touch);
        if (said != null) Debug.Log(said);
    }

    void OnDestroy()
    {
        isRunning = false;
        if (haptics != null) haptics.Join();
        if (skin != null) skin.Dispose();
        if (finger != null) finger.Dispose();
        if (world != null) world.Dispose();
    }

    void MakeMesh()
    {
        vertices = new Vector3[skin.Vertices];
        directions = new Vector3[skin.Vertices];
        mesh = new Mesh { indexFormat = UnityEngine.Rendering.IndexFormat.UInt32 };
        mesh.MarkDynamic();
        TakeSkin();
        int[] triangles = world.Triangles();
        InUnity.TurnTriangles(triangles);
        mesh.triangles = triangles;
        mesh.RecalculateBounds();
        GetComponent<MeshFilter>().mesh = mesh;
        // The fingertip; its material is that of the project's render pipeline.
        var ball = GameObject.CreatePrimitive(PrimitiveType.Sphere);
        tip = ball.transform;
        tip.localScale = Vector3.one * (float)(2 * RadiusMm * InUnity.MetresPerMm);
        GetComponent<MeshRenderer>().sharedMaterial = ball.GetComponent<MeshRenderer>().sharedMaterial;
    }

    void TakeSkin()
    {
        positions = skin.Positions(positions);
        normals = skin.Normals(normals);
        InUnity.FromBody(positions);
        for (int i = 0; i < vertices.Length; ++i)
        {
            vertices[i] = new Vector3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
            directions[i] = new Vector3(normals[3 * i], normals[3 * i + 1], -normals[3 * i + 2]);
        }
        mesh.SetVertices(vertices);
        mesh.SetNormals(directions);
    }

    unsafe void Show(Touch touch)
    {
        TakeSkin();
        const float toMetres = InUnity.MetresPerMm;
        tip.position = transform.TransformPoint(
            new Vector3((float)touch.ProxyMm[0] * toMetres, (float)touch.ProxyMm[1] * toMetres, -(float)touch.ProxyMm[2] * toMetres));
    }
}
