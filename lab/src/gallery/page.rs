//! The page of the gallery.

use super::facts;
use super::shot::{Shot, Shown};
use super::table::{Figure, Part, Picture};
use crate::page::{self, live::Live};
use drape::error::Result;

/// A picture of the table, what was asked for, and how it came out.
type Made<'a> = (&'a Picture, &'a Shot, &'a Shown);

/// What this page adds to the style of all pages.
const STYLE: &str = "<style>section{border-top:1px solid var(--line);padding:.6rem 0 1rem}h3{margin:.2rem 0 .6rem}\
figure{margin:0}.row>figure{max-width:32.2rem}.row>div{flex:1 1 19rem;min-width:0}img{image-rendering:auto}\
.note{border-left:4px solid var(--b);padding-left:.7rem}dl{margin:.5rem 0}dt{font-weight:600}dd{margin:0 0 .5rem}\
nav a{margin-right:.6rem;display:inline-block}pre{white-space:pre-wrap}</style>\n";

const TEXT: &str = "<p>Every figure of the report (a write-up of the course project ClothSim), made by one program from its built-in scenes. \
The command under a picture, run in the program's source folder, makes that picture with the same bytes. \
Pictures are shown at half their size; a click opens the full size. Where a figure came from a fault, \
the stable or correct picture is shown beside it.</p>\n\
<p><b>Stability</b> is the step times the highest angular frequency of the springs, and the limit below which \
Verlet's scheme is stable. <b>Energy</b> is the ledger: what each phase of the method put into the cloth (+) or \
took out of it (−) from the start to the picture. Gravity exchanges motion and height, and springs exchange motion \
and stretch, without loss; their entries hold only what the finite step adds.</p>\n";

/// The page of `parts`, whose pictures were asked for as `shots` and came out as `shown`, in the same order; with links
/// to a live page, if there is one.
///
/// # Errors
/// As [`Picture::live_parts`].
pub fn page(parts: &[Part], shots: &[Shot], shown: &[Shown], live: Option<&Live>) -> Result<String> {
    let mut made = shots.iter().zip(shown);
    let (mut contents, mut sections) = (String::new(), String::new());
    for part in parts.iter().filter(|part| !part.figures.is_empty()) {
        let title = page::escape(&part.title);
        contents += &format!("<p><b>{title}</b><br>\n");
        contents.extend(part.figures.iter().map(|figure| link(figure.name())));
        contents += "</p>\n";
        sections += &format!("<h2>{title}</h2>\n");
        for figure in &part.figures {
            let pictures = figure.pictures.iter().zip(&mut made);
            let pictures: Vec<_> = pictures.map(|(picture, (shot, shown))| (picture, shot, shown)).collect();
            sections += &section(figure, &pictures, live)?;
        }
    }
    let head = page::head("The figures of the report");
    Ok(head + STYLE + TEXT + "<nav>\n" + &contents + "</nav>\n" + &sections + page::END)
}

fn link(name: &str) -> String {
    let name = page::escape(name);
    format!("<a href=\"#{name}\">{name}</a>\n")
}

fn section(figure: &Figure, pictures: &[Made<'_>], live: Option<&Live>) -> Result<String> {
    let name = page::escape(figure.name());
    let note = match figure.note.as_str() {
        "" => String::new(),
        note => format!("<p class=\"note\">{}</p>\n", page::escape(note)),
    };
    let cells = match pictures {
        [one] => format!("{}<div>\n{}</div>\n", shown(one), details(one, live)?),
        several => {
            let cell = |picture| Ok(format!("<div>\n{}{}</div>\n", shown(picture), details(picture, live)?));
            several.iter().map(cell).collect::<Result<String>>()?
        }
    };
    Ok(format!(
        "<section id=\"{name}\">\n<h3>{name}</h3>\n{note}<div class=\"row\">\n{cells}</div>\n</section>\n"
    ))
}

fn shown((picture, _, shown): &Made<'_>) -> String {
    let (name, caption) = (page::escape(&picture.name), page::escape(&picture.caption));
    let image = page::image(&picture.name, &shown.half);
    format!("<figure><a href=\"{name}.png\">{image}</a>\n<figcaption>{caption}</figcaption></figure>\n")
}

fn details((picture, shot, shown): &Made<'_>, live: Option<&Live>) -> Result<String> {
    let terms = [
        ("Parameters", facts::parameters(shot, &shown.state)),
        ("Stability", facts::margin(&shown.state)),
        ("Energy", facts::ledger(&shown.state)),
    ];
    let terms: String = terms
        .iter()
        .map(|(term, text)| format!("<dt>{term}</dt><dd>{}</dd>\n", page::escape(text)))
        .collect();
    let link = live.map_or_else(|| Ok(String::new()), |live| link_to_live(picture, shot, live))?;
    Ok(format!("<dl>\n{terms}</dl>\n<pre>{}</pre>\n{link}", page::escape(&picture.command())))
}

/// The link to the moment of a picture.
fn link_to_live(picture: &Picture, shot: &Shot, live: &Live) -> Result<String> {
    let parts = picture.live_parts()?;
    let [width, height] = shot.scene.render.size;
    let (frame, size) = (shot.frame.to_string(), format!("{width}x{height}"));
    let moment = [("frame", frame.as_str()), ("size", size.as_str())];
    let parts = parts.iter().map(|(name, value)| (*name, value.as_str())).chain(moment);
    Ok(format!("<p>{}</p>\n", live.with(parts).link("Open it on the live page")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::reel::Reel;
    use crate::gallery::table::parts;
    use crate::store::Store;
    use drape::output::provenance::Provenance;
    use drape::render::Options;
    use drape::scene::{Overrides, load_text};

    /// Each picture of the table shown by one and the same tiny picture.
    #[test]
    fn the_page_has_every_figure_with_all_that_belongs_to_it() {
        let text =
            r#"{"sphere": {"origin": [0, 0, 0], "radius": 1, "friction": 0}, "render": {"size": [2, 2]}}"#;
        let scene = load_text("ball", text, &Overrides::default()).unwrap().scene;
        let (options, provenance) = (Options::default(), Provenance::default());
        let shot = Shot { scene, options, frame: 0, allow_unstable: false, provenance };
        let folder = tempfile::tempdir().unwrap();
        let store = Store::new(folder.path(), |_, _| Ok(())).unwrap();
        let shown = Reel::new(std::slice::from_ref(&shot), true, &store).take(&|| Ok(())).unwrap();
        let parts = parts().unwrap();
        let pictures = parts.iter().flat_map(|part| &part.figures).flat_map(|figure| &figure.pictures);
        let count = pictures.count();
        let (shots, shown) = (vec![shot; count], vec![shown[0].clone(); count]);
        let linked = page(&parts, &shots, &shown, Some(&Live::at("live.html"))).unwrap();
        assert_eq!(linked.matches("<a href=\"live.html#paused&amp;scene=").count(), count);
        let page = page(&parts, &shots, &shown, None).unwrap();

        assert_eq!(page.matches("<section id=").count(), 51);
        assert_eq!(page.matches("<h2>").count(), parts.len());
        for figure in parts.iter().flat_map(|part| &part.figures) {
            let start = format!("<section id=\"{}\">", figure.name());
            let section = page.split(&start).nth(1).unwrap().split("</section>").next().unwrap();
            assert!(page.contains(&format!("<a href=\"#{}\">", figure.name())));
            assert!(section.contains(&page::escape(&figure.note)));
            let count = figure.pictures.len();
            for part in
                ["<img alt=", "<figcaption>", "<dt>Stability</dt>", "<dt>Energy</dt>", "<dt>Parameters</dt>"]
            {
                assert_eq!(section.matches(part).count(), count, "{part} of {}", figure.name());
            }
            for picture in &figure.pictures {
                assert!(section.contains(&page::escape(&picture.caption)), "{}", picture.name);
                assert!(section.contains(&format!("<pre>{}</pre>", page::escape(&picture.command()))));
                assert!(section.contains(&format!("<a href=\"{}.png\">", picture.name)));
            }
        }
        assert!(!page.contains("http") && !page.contains("<script"));
    }
}
