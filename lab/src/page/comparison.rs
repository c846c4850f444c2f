//! The comparison of two pictures on a web page, with the pictures inside it.

use super::html;
use drape::error::Result;
use drape::output::compare::difference_picture;
use drape::output::png::{self, Effort, Pixels};

/// One comparison on the page.
pub struct Row<'a> {
    /// What is compared.
    pub title: &'a str,
    /// What was found, one line.
    pub verdict: &'a str,
    /// The expected and the actual picture.
    pub pictures: [&'a Pixels; 2],
}

impl Row<'_> {
    /// A heading, the verdict, and expected, difference and actual side by side.
    ///
    /// # Errors
    /// As [`png::encode`].
    pub fn html(&self) -> Result<String> {
        let [expected, actual] = self.pictures;
        let difference = difference_picture(expected, actual);
        let mut text = format!(
            "<h2>{}</h2><p>{}</p>\n<div class=\"row\">\n",
            html::escape(self.title),
            html::escape(self.verdict)
        );
        for (caption, picture) in [("expected", expected), ("difference", &difference), ("actual", actual)] {
            text += &figure(caption, picture, Effort::Fast)?;
        }
        Ok(text + "</div>\n")
    }
}

/// A heading and why the pictures below it were not compared.
pub fn unread(title: &str, why: &str) -> String {
    format!("<h2>{}</h2><p>not compared: {}</p>\n", html::escape(title), html::escape(why))
}

/// A picture with its caption below it.
///
/// # Errors
/// As [`png::encode`].
pub fn figure(caption: &str, picture: &Pixels, effort: Effort) -> Result<String> {
    let bytes = png::encode(picture.width, picture.height, picture.rgba.as_flattened(), effort)?;
    let image = html::image(caption, &bytes);
    Ok(format!("<figure>{image}<figcaption>{}</figcaption></figure>\n", html::escape(caption)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_holds_the_three_pictures_and_escapes_names() {
        let a = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 3, 255]] };
        let b = Pixels { width: 1, height: 1, rgba: vec![[1, 2, 4, 255]] };
        let text = Row { title: "<a&b>", verdict: "\"1\" of 1", pictures: [&a, &b] }.html().unwrap();
        assert_eq!(text.matches("data:image/png;base64,iVBOR").count(), 3);
        assert!(text.contains("&lt;a&amp;b&gt;") && text.contains("&quot;1&quot;"));
    }
}
