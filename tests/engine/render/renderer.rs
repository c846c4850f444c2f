//! One renderer and one framebuffer draw many pictures.

use drape::{
    raster::Framebuffer,
    render::{Options, Renderer},
    scene::{Overrides, load_text},
    simulation::Simulation,
    texture_source::TextureSource,
};

const BALL: &str = r#"{"sphere": {"origin": [0.5, 0.5, 0.5], "radius": 0.3, "friction": 0},
    "render": {"size": [70, 66]}}"#;

/// Of a ball at this height.
fn renderer(height: f64) -> (Renderer, Simulation) {
    let overrides =
        Overrides { sets: vec![format!("sphere.origin=[0.5,{height},0.5]")], ..Overrides::default() };
    let scene = load_text("ball", BALL, &overrides).expect("a scene").scene;
    let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).expect("a renderer");
    (renderer, Simulation::new(&scene).expect("a simulation"))
}

#[test]
fn a_framebuffer_keeps_nothing_of_the_picture_before() {
    let (high, simulation) = renderer(0.5);
    let mut framebuffer: Framebuffer = high.framebuffer();
    let with_ids = Options { ids: true, ..Options::default() };
    high.draw_into(&mut framebuffer, simulation.positions(), &with_ids);
    assert_eq!(framebuffer.ids().len(), 70 * 66);
    assert!(framebuffer.ids().iter().any(|&id| id >> 24 == 1), "the ball is object 1");
    let first = (framebuffer.rgb(), framebuffer.depth());
    high.draw_into(&mut framebuffer, simulation.positions(), &Options::default());
    assert_eq!(framebuffer.ids(), Vec::<u32>::new(), "no ids were asked for");
    assert_eq!((framebuffer.rgb(), framebuffer.depth()), first);
    let (low, simulation) = renderer(0.4);
    low.draw_into(&mut framebuffer, simulation.positions(), &Options::default());
    let afresh = low.draw(simulation.positions(), &Options::default());
    assert_ne!(afresh.rgb, first.0);
    assert_eq!((framebuffer.rgb(), framebuffer.depth()), (afresh.rgb, afresh.depth));
}

#[test]
fn a_renderer_changes_its_scene_and_keeps_what_it_has_read() {
    let scene = |shader: &str, size: &str| {
        let sets = vec![format!("sphere.material.shader={shader}"), format!("render.size={size}")];
        load_text("ball", BALL, &Overrides { sets, ..Overrides::default() }).unwrap().scene
    };
    let afresh = |shader, size| Renderer::new(&scene(shader, size), &TextureSource::BuiltIn).unwrap();
    let picture = |renderer: &Renderer| {
        renderer.draw(Simulation::new(&scene("phong", "[8,8]")).unwrap().positions(), &Options::default()).rgb
    };
    let mut renderer = afresh("texture", "[70,66]");
    // A folder without textures: the one that was read already is not looked for again.
    let nothing = TextureSource::Folder("no folder".into());
    renderer.change_scene(&scene("texture", "[50,40]"), &nothing).unwrap();
    assert_eq!(picture(&renderer), picture(&afresh("texture", "[50,40]")));
    let before = picture(&renderer);
    renderer.change_scene(&scene("mirror", "[50,40]"), &nothing).unwrap_err();
    assert_eq!(picture(&renderer), before, "a scene that cannot be drawn changes nothing");
    renderer.change_scene(&scene("mirror", "[30,20]"), &TextureSource::BuiltIn).unwrap();
    assert_eq!(picture(&renderer), picture(&afresh("mirror", "[30,20]")));
}
