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

fn renderer() -> (Renderer, Simulation) {
    let scene = load_text("ball", BALL, &Overrides::default()).expect("a scene").scene;
    let renderer = Renderer::new(&scene, &TextureSource::BuiltIn).expect("a renderer");
    (renderer, Simulation::new(&scene).expect("a simulation"))
}

#[test]
fn a_framebuffer_keeps_nothing_of_the_picture_before() {
    let (renderer, simulation) = renderer();
    let mut framebuffer: Framebuffer = renderer.framebuffer();
    let with_ids = Options { ids: true, ..Options::default() };
    renderer.draw_into(&mut framebuffer, simulation.positions(), &with_ids);
    assert_eq!(framebuffer.ids().len(), 70 * 66);
    assert!(framebuffer.ids().iter().any(|&id| id >> 24 == 1), "the ball is object 1");
    let first = (framebuffer.rgb(), framebuffer.depth());
    renderer.draw_into(&mut framebuffer, simulation.positions(), &Options::default());
    assert_eq!(framebuffer.ids(), Vec::<u32>::new(), "no ids were asked for");
    assert_eq!((framebuffer.rgb(), framebuffer.depth()), first);
}
