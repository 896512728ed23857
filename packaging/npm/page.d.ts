/** Folder of the page's files, index.html among them: serve it with any web server. Node only. */
export declare const pageFolder: string;
